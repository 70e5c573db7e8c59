// The last failure of each thread. It is the one thing that a thread keeps to itself: a C function
// returns a number, and whoever asks what it means is in the thread that called.
#include "errors.hpp"

#include <algorithm>
#include <array>
#include <new>
#include <vector>

#include "structs.hpp"

namespace lm {
namespace {

using mesher::Error;
using mesher::ErrorCode;

static_assert(status_of(ErrorCode::duplicate_point) == LM_DUPLICATE_POINT);
static_assert(status_of(ErrorCode::truncated) == LM_TRUNCATED);
static_assert(status_of(ErrorCode::bad_option) == LM_BAD_OPTION);
static_assert(status_of(ErrorCode::cancelled) == LM_CANCELLED);
static_assert(status_of(ErrorCode::overlapping_polygons) == LM_OVERLAPPING_POLYGONS);
static_assert(static_cast<int>(mesher::FeatureKind::region) == LM_REGION);

constexpr std::array<const char*, 9> kNames{
    "ok",   "bad_handle",    "null_pointer", "bad_size",       "bad_argument",
    "busy", "out_of_memory", "internal",     "nothing_to_undo"};

struct Record {
  lm_status status = LM_OK;
  std::string message, file;
  long line = 0, column = 0;
  std::vector<std::int32_t> kinds;
  std::vector<std::int64_t> ids;
  std::vector<double> at;
};

// A pointer, so that a thread that ends frees it and one that never failed has none.
thread_local Record last;

void set(lm_status status, const std::string& message, const Error* error = nullptr) {
  Record record{status, message, {}, 0, 0, {}, {}, {}};
  if (error != nullptr) {
    record.file = error->location().file;
    record.line = error->location().line;
    record.column = error->location().column;
    for (const mesher::Feature& f : error->features()) {
      record.kinds.push_back(static_cast<std::int32_t>(f.kind));
      record.ids.push_back(f.number);
    }
    for (const mesher::Position& p : error->places()) {
      record.at.insert(record.at.end(), p.begin(), p.end());
    }
  }
  last = std::move(record);
}

// Without memory for a record: the status alone.
void set_bare(lm_status status) noexcept {
  last.status = status;
  last.message.clear();
  last.file.clear();
  last.line = last.column = 0;
  last.kinds.clear();
  last.ids.clear();
  last.at.clear();
}

lm_status record_current() {
  try {
    throw;
  } catch (const Failure& failure) {
    set(failure.status(), failure.what());
  } catch (const Error& error) {
    set(status_of(error.code()), error.message(), &error);
  } catch (const std::bad_alloc&) {
    set_bare(LM_OUT_OF_MEMORY);
  } catch (const std::length_error&) {
    set_bare(LM_OUT_OF_MEMORY);
  } catch (const std::exception& error) {
    set(LM_INTERNAL, error.what());
  } catch (...) {
    set(LM_INTERNAL, "an exception of an unknown type");
  }
  return last.status;
}

}  // namespace

lm_status record_failure() noexcept {
  try {
    return record_current();
  } catch (...) {
    set_bare(LM_OUT_OF_MEMORY);
    return LM_OUT_OF_MEMORY;
  }
}

void require_pointer(const void* pointer, const char* what) {
  if (pointer == nullptr) throw Failure(LM_NULL_POINTER, std::string(what) + " is NULL");
}
void require_count(std::size_t n, const char* what) {
  if (n > UINT32_MAX)
    throw Failure(LM_BAD_ARGUMENT, std::string(what) + " has 2^32 elements or more");
}
void require_array(const void* pointer, std::size_t n, const char* what) {
  if (n > 0) require_pointer(pointer, what);
  require_count(n, what);
}

}  // namespace lm

using namespace lm;

const char* lm_status_name(lm_status status) {
  if (status >= 0 && static_cast<std::size_t>(status) < kNames.size()) {
    return kNames[static_cast<std::size_t>(status)];
  }
  if (status < LM_DUPLICATE_POINT || status > LM_OVERLAPPING_POLYGONS) return "unknown";
  return mesher::code_name(static_cast<ErrorCode>(status - LM_DUPLICATE_POINT)).data();
}

lm_status lm_last_error(lm_error* error) {
  if (error == nullptr) return LM_NULL_POINTER;
  const bool is_bare = last.status == LM_OUT_OF_MEMORY && last.message.empty();
  lm_error all{};
  all.status = last.status;
  all.name = lm_status_name(last.status);
  all.message = is_bare ? "out of memory" : last.message.c_str();
  all.file = last.file.c_str();
  all.line = last.line;
  all.column = last.column;
  all.features = last.kinds.size();
  all.feature_kinds = last.kinds.data();
  all.feature_ids = last.ids.data();
  all.places = last.at.size() / 3;
  all.at = last.at.data();
  return write_struct(all, error) ? LM_OK : LM_BAD_SIZE;  // without a record: it would be lost
}
