# Windows on x86-64, compiled on a Debian machine and run there by wine:
#   apt-get install g++-mingw-w64-x86-64-posix libz-mingw-w64-dev wine64
# Headers without compiled parts are those of the machine, reached by links: in /usr/include they
# lie beside those of its C library.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR AMD64)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
set(CMAKE_CROSSCOMPILING_EMULATOR /usr/lib/wine/wine64)
set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(ZLIB_LIBRARY /usr/x86_64-w64-mingw32/lib/libz.a CACHE FILEPATH "")
set(ZLIB_INCLUDE_DIR /usr/x86_64-w64-mingw32/include CACHE PATH "")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static -Wl,--stack,8388608")  # as much stack as Linux gives

set(header_packages ${CMAKE_BINARY_DIR}/header_packages)
get_property(tries GLOBAL PROPERTY IN_TRY_COMPILE)
if(NOT tries)
  foreach(folder include/CLI include/nlohmann include/tsl include/catch2 lib/libCatch2WithMain.a)
    cmake_path(GET folder PARENT_PATH parent)
    file(MAKE_DIRECTORY ${header_packages}/${parent})
    file(CREATE_LINK /usr/${folder} ${header_packages}/${folder} SYMBOLIC)
  endforeach()
  foreach(package share/cmake/CLI11 share/cmake/nlohmann_json share/cmake/tsl-robin-map
          lib/cmake/Catch2)
    cmake_path(GET package PARENT_PATH parent)
    file(COPY /usr/${package} DESTINATION ${header_packages}/${parent})
  endforeach()
endif()
list(APPEND CMAKE_PREFIX_PATH ${header_packages})
