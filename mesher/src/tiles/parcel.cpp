// Errors as bytes.
#include "tiles/parcel.hpp"

namespace mesher::detail {

namespace {

void pack(const FileLocation& location, Packer& to) {
  to.put_all(std::string_view(location.file));
  to.put(location.line), to.put(location.column);
}
FileLocation unpack_location(Unpacker& from) {
  FileLocation location;
  location.file = from.take_text();
  location.line = from.take<long>();
  location.column = from.take<long>();
  return location;
}

}  // namespace

void pack(const Error& error, Packer& to) {
  to.put(error.code());
  to.put_all(std::string_view(error.message()));
  pack(error.location(), to);
  to.put_all(error.features());
  to.put_all(error.places());
}

Error unpack_error(Unpacker& from) {
  const auto code = from.take<ErrorCode>();
  std::string message = from.take_text();
  FileLocation location = unpack_location(from);
  auto features = from.take_all<mesher::Feature>();
  auto places = from.take_all<Position>();
  return {code, std::move(message), std::move(location), std::move(features), std::move(places)};
}

}  // namespace mesher::detail
