// Errors, and places in files, as bytes.
#include "tiles/parcel.hpp"

namespace mesher::detail {

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

void pack(const Error& error, Packer& to) {
  to.put(error.code());
  to.put_all(std::string_view(error.message()));
  pack(error.location(), to);
  to.put_all(error.features());
  to.put_all(error.places());
  to.put(std::uint64_t{error.locations().size()});
  for (const FileLocation& at : error.locations()) pack(at, to);
}

Error unpack_error(Unpacker& from) {
  const auto code = from.take<ErrorCode>();
  std::string message = from.take_text();
  FileLocation location = unpack_location(from);
  auto features = from.take_all<mesher::Feature>();
  auto places = from.take_all<Position>();
  std::vector<FileLocation> locations;
  for (auto left = from.take<std::uint64_t>(); left > 0; --left) {
    locations.push_back(unpack_location(from));
  }
  return Error(code, std::move(message), std::move(location), std::move(features),
               std::move(places))
      .with_locations(std::move(locations));
}

}  // namespace mesher::detail
