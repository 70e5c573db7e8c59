// For loops over lanes of doubles: they are also compiled for machines with registers of four
// doubles, and glibc chooses the version when the program starts. The results are the same bits:
// operations are not fused. (Not with clang: its version 14 gives the resolver another name, which
// other files do not find. Nor with the thread sanitizer, which is not ready when it is called.)
#pragma once

#include <cstddef>  // says whether the C library is glibc

#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__clang__) && \
    !defined(__SANITIZE_THREAD__)
#define MESHER_WIDE_LANES [[gnu::target_clones("avx2", "default")]]
#else
#define MESHER_WIDE_LANES
#endif
