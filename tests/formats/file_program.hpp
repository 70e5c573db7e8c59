// What programs have in common that write meshes for others to read, and say what they read.
#pragma once

#include <exception>
#include <iostream>
#include <string>

namespace formats {

/// Does what the command line says: `write FOLDER` calls write(folder), and `dump MESH TRUTH`
/// dump(mesh, truth). The exit code: 1 after an exception, which is told, 2 for another line.
template <class Write, class Dump>
int file_program(int argc, char** argv, Write&& write, Dump&& dump) {
  const std::string command = argc > 1 ? argv[1] : "";
  try {
    if (command == "write" && argc == 3) {
      write(std::string(argv[2]));
    } else if (command == "dump" && argc == 4) {
      dump(argv[2], argv[3]);
    } else {
      return 2;
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}

}  // namespace formats
