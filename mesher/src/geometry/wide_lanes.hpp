// For loops over lanes of doubles: compiled also for machines with registers of four, and chosen
// when the program starts, which glibc can. The results are the same bits: operations are not
// fused. (Not by clang: its version 14 gives what chooses another name, which other files do not
// find.)
#pragma once

#include <cstddef>  // says whether the C library is glibc

#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__clang__)
#define MESHER_WIDE_LANES [[gnu::target_clones("avx2", "default")]]
#else
#define MESHER_WIDE_LANES
#endif
