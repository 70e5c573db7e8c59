# Debian packages, by cpack; ./run package makes them. Included by the top of the project, last.
#
#   liblivemesh1      the shared library of the C interface       (component runtime)
#   libmesher-dev     headers, static libraries, CMake packages   (development)
#   mesher            the tools mesher and traces, with manual pages and completions (tools)
#   python3-livemesh  the Python package, for Debian's python3    (python)
set(here ${CMAKE_CURRENT_LIST_DIR})
set(version ${PROJECT_VERSION})

# The library, apart from the component livemesh, in the two parts that Debian has for one.
install(TARGETS livemesh LIBRARY COMPONENT runtime EXCLUDE_FROM_ALL OPTIONAL NAMELINK_SKIP)
install(TARGETS livemesh LIBRARY COMPONENT development EXCLUDE_FROM_ALL OPTIONAL NAMELINK_ONLY)
install(FILES mesher/c/include/livemesh.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT development EXCLUDE_FROM_ALL)

# The Python package calls the library of liblivemesh1.
set(python_folder lib/python3/dist-packages)
set(module ${python_folder}/livemesh)
install(DIRECTORY mesher/python/livemesh DESTINATION ${python_folder} COMPONENT python
  EXCLUDE_FROM_ALL FILES_MATCHING PATTERN *.py PATTERN py.typed PATTERN __pycache__ EXCLUDE)
install(FILES mesher/python/README.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-livemesh
  COMPONENT python EXCLUDE_FROM_ALL)
install(DIRECTORY mesher/python/examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-livemesh
  COMPONENT python EXCLUDE_FROM_ALL FILES_MATCHING PATTERN *.py)
install(CODE "
  set(module \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${module}\")
  file(RELATIVE_PATH library /${module} /${CMAKE_INSTALL_LIBDIR}/liblivemesh.so.1)
  file(CREATE_LINK \"\${library}\" \"\${module}/liblivemesh.so\" SYMBOLIC)
  execute_process(COMMAND python3 -B -c \"
import pathlib, sys
import build_livemesh
info = pathlib.Path(sys.argv[1], build_livemesh.NAME + '.dist-info')
info.mkdir(exist_ok=True)
(info / 'METADATA').write_bytes(build_livemesh.metadata()['METADATA'])
(info / 'INSTALLER').write_text('dpkg')
\" \"\${module}/..\" WORKING_DIRECTORY \"${PROJECT_SOURCE_DIR}/mesher/python\"
    COMMAND_ERROR_IS_FATAL ANY)
" COMPONENT python EXCLUDE_FROM_ALL)

# As Debian's own tools have it: who makes the packages says so in the environment.
set(CPACK_PACKAGE_CONTACT "The project's authors <root@localhost>")
if(DEFINED ENV{DEBEMAIL})
  set(CPACK_PACKAGE_CONTACT "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()

# What every package has: its licence, and what has changed. package_files(NAME) writes both.
file(READ LICENSE licence)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # SOURCE_DATE_EPOCH, if that is set
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS LICENSE)
function(package_files name)
  set(folder ${PROJECT_BINARY_DIR}/packages/${name})
  file(WRITE ${folder}/copyright "${PROJECT_NAME}\n\n${licence}")
  file(WRITE ${folder}/changelog "${name} (${version}) unstable; urgency=medium\n\n"
    "  * Version ${version}.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  if(GZIP)
    execute_process(COMMAND ${GZIP} -9nf ${folder}/changelog)
  endif()
endfunction()

set(CPACK_GENERATOR DEB)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL runtime development tools python)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY >=)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

# debian_package(COMPONENT NAME SECTION DEPENDS SUMMARY TEXT)
macro(debian_package component name section depends summary text)
  string(TOUPPER ${component} key)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS "${depends}")
  set(CPACK_DEBIAN_${key}_DESCRIPTION "${summary}\n${text}")
  package_files(${name})
  install(DIRECTORY ${PROJECT_BINARY_DIR}/packages/${name} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc
    COMPONENT ${component} EXCLUDE_FROM_ALL)
endmacro()

set(about "Delaunay meshes of triangles and of tetrahedra with a bound on their quality,
of points, lines and polygons. An edit of the input costs what it changes.")
debian_package(runtime liblivemesh1 libs ""
  "quality meshes that follow their input: shared library" "${about}")
debian_package(development libmesher-dev libdevel "liblivemesh1 (= ${version}), zlib1g-dev"
  "quality meshes that follow their input: headers and libraries"
  "${about}
Libraries for C++ (sac, mesher, traces, with CMake packages), and for C
(livemesh).")
debian_package(tools mesher science ""
  "quality meshes that follow their input: command line tools" "${about}")
debian_package(python python3-livemesh python
  "liblivemesh1 (= ${version}), python3 (>= 3.9), python3-numpy"
  "quality meshes that follow their input: Python package" "${about}")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${here}/triggers)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${here}/postinst ${here}/prerm)

include(CPack)
