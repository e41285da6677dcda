# What is installed beside the programs, and the Debian packages: reachlab-cli (no Qt, no VTK), reachlab (the window), reachlab-mpi (studies over
# the ranks of an MPI job), reachlab-doc (the manual). `packaging/deb` builds them out of one build tree for each level of processor.
if(REACHLAB_PACKAGES STREQUAL PROGRAMS)  # a level beside the one that packs the rest
  return()
endif()
set(packaging ${PROJECT_SOURCE_DIR}/packaging)
set(share ${CMAKE_INSTALL_DATADIR})

install(DIRECTORY resources/ DESTINATION ${share}/reachlab PATTERN make_sounds.py EXCLUDE PATTERN *.ts EXCLUDE PATTERN LICENSE EXCLUDE)
install(DIRECTORY constraints/definitions DESTINATION ${share}/reachlab)
file(GLOB udev_rules CONFIGURE_DEPENDS ${packaging}/udev/*.rules)
if(udev_rules)
  install(FILES ${udev_rules} DESTINATION lib/udev/rules.d)
endif()
if(REACHLAB_GUI)
  install(FILES ${packaging}/linux/reachlab.desktop DESTINATION ${share}/applications COMPONENT gui)
  install(FILES ${packaging}/linux/org.reachlab.Reachlab.metainfo.xml DESTINATION ${share}/metainfo COMPONENT gui)
  install(FILES resources/icons/reachlab.svg DESTINATION ${share}/icons/hicolor/scalable/apps COMPONENT gui)
  foreach(size 16 24 32 48 64 128 256)
    install(FILES ${packaging}/icons/reachlab-${size}.png DESTINATION ${share}/icons/hicolor/${size}x${size}/apps RENAME reachlab.png COMPONENT gui)
  endforeach()
endif()

if(NOT REACHLAB_PACKAGES)
  return()
endif()

set(programs reach)
if(REACHLAB_GUI)
  list(APPEND programs reachlab)
endif()
if(TARGET reach-mpi)
  list(APPEND programs reach-mpi)
endif()
set(component_of_reach cli)
set(component_of_reachlab gui)
set(component_of_reach-mpi mpi)

# On the path: what picks the level.
foreach(program ${programs})
  add_executable(level-${program} cli/level/main.cpp)
  target_compile_definitions(level-${program} PRIVATE REACHLAB_PROGRAM="${program}" REACHLAB_LIBEXEC_FROM_BIN="${REACHLAB_LIBEXEC_FROM_BIN}")
  target_compile_options(level-${program} PRIVATE -march=x86-64 -mtune=generic)
  set_target_properties(level-${program} PROPERTIES OUTPUT_NAME ${program} RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/level)
  install(TARGETS level-${program} DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ${component_of_${program}})
endforeach()

# Man pages and completions, out of the programs' own --help.
set(pages ${PROJECT_BINARY_DIR}/command-pages)
foreach(program ${programs})
  list(APPEND program_files $<TARGET_FILE:${program}>)
endforeach()
add_custom_command(OUTPUT ${pages}/made
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${pages}
  COMMAND /usr/bin/python3 ${packaging}/manual/command_pages.py ${PROJECT_VERSION} ${pages} ${program_files}
  COMMAND sh -c "gzip -9n ${pages}/man1/*"
  COMMAND ${CMAKE_COMMAND} -E touch ${pages}/made
  DEPENDS ${programs} ${packaging}/manual/command_pages.py ${packaging}/manual/command_line.py ${packaging}/manual/completions.py VERBATIM)
add_custom_target(command_pages ALL DEPENDS ${pages}/made)
foreach(program ${programs})
  set(component ${component_of_${program}})
  install(FILES ${pages}/bash/${program} DESTINATION ${share}/bash-completion/completions COMPONENT ${component})
  install(FILES ${pages}/zsh/_${program} DESTINATION ${share}/zsh/vendor-completions COMPONENT ${component})
  install(FILES ${pages}/fish/${program}.fish DESTINATION ${share}/fish/vendor_completions.d COMPONENT ${component})
  set(others "")  # reach-mpi is no command of reach
  foreach(other ${programs})
    if(other MATCHES "^${program}-")
      list(APPEND others PATTERN ${other}.1.gz EXCLUDE)
    endif()
  endforeach()
  install(DIRECTORY ${pages}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT ${component}
    FILES_MATCHING PATTERN ${program}.1.gz PATTERN ${program}-*.1.gz ${others})
endforeach()

# The manual as a site.
file(GLOB_RECURSE manual_sources CONFIGURE_DEPENDS docs/* packaging/manual/site/*)
list(APPEND manual_sources ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/CONTRIBUTING.md)
add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/manual/index.html
  COMMAND ${packaging}/manual/build ${PROJECT_BINARY_DIR}/manual
  DEPENDS ${manual_sources} ${packaging}/manual/build ${packaging}/manual/check_site.py VERBATIM)
add_custom_target(manual ALL DEPENDS ${PROJECT_BINARY_DIR}/manual/index.html)
install(DIRECTORY ${PROJECT_BINARY_DIR}/manual/ DESTINATION ${share}/doc/reachlab/html COMPONENT doc)

# Debian's own files in each package.
configure_file(${packaging}/debian/changelog.in ${PROJECT_BINARY_DIR}/debian/changelog @ONLY)
execute_process(COMMAND gzip -9nfk ${PROJECT_BINARY_DIR}/debian/changelog COMMAND_ERROR_IS_FATAL ANY)
foreach(pair cli=reachlab-cli gui=reachlab mpi=reachlab-mpi doc=reachlab-doc)
  string(REGEX MATCH "(.*)=(.*)" _ ${pair})
  install(FILES ${packaging}/debian/copyright ${PROJECT_BINARY_DIR}/debian/changelog.gz DESTINATION ${share}/doc/${CMAKE_MATCH_2} COMPONENT ${CMAKE_MATCH_1})
endforeach()
install(FILES ${packaging}/linux/limits.conf DESTINATION /etc/security/limits.d RENAME reachlab.conf)

set(CPACK_GENERATOR DEB)
set(CPACK_SET_DESTDIR ON)
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_NAME reachlab)
set(CPACK_PACKAGE_CONTACT "The Reachlab authors <authors@reachlab.invalid>")
set(CPACK_OUTPUT_FILE_PREFIX ${PROJECT_BINARY_DIR}/packages)
set(CPACK_COMPONENTS_ALL cli doc)
if(REACHLAB_GUI)
  list(APPEND CPACK_COMPONENTS_ALL gui)
endif()
if(TARGET reach-mpi)
  list(APPEND CPACK_COMPONENTS_ALL mpi)
endif()
set(CPACK_INSTALL_CMAKE_PROJECTS "${PROJECT_BINARY_DIR};reachlab;ALL;/")
foreach(tree ${REACHLAB_LEVEL_TREES})
  list(APPEND CPACK_INSTALL_CMAKE_PROJECTS ${tree} reachlab ALL /)
endforeach()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_NAME} built using CMake")  # any other would stand before each package's own first line
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_CLI_PACKAGE_NAME reachlab-cli)
set(CPACK_DEBIAN_CLI_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_CLI_PACKAGE_DEPENDS "adduser, fonts-dejavu-core")
set(CPACK_DEBIAN_CLI_PACKAGE_SUGGESTS "reachlab-doc")
set(CPACK_DEBIAN_CLI_PACKAGE_CONTROL_EXTRA "${packaging}/debian/preinst;${packaging}/debian/postinst;${packaging}/debian/postrm;${packaging}/debian/conffiles")
set(CPACK_DEBIAN_CLI_DESCRIPTION "laboratory for reaching movements: command line
Records, judges, predicts and analyses how people move masses and springs that
are bound to curves and surfaces, from rest to rest. The program reach does
every job of the window of package reachlab: sessions with a force device or a
simulated subject, datasets in Motion-BIDS and CSV, tables, figures.

For processors of level x86-64-v2 (most since 2009) and newer: the programs are
there for several levels, with the same results to the bit, and the quickest
that the processor runs is started.")
set(CPACK_DEBIAN_MPI_PACKAGE_NAME reachlab-mpi)
set(CPACK_DEBIAN_MPI_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS "reachlab-cli (= ${PROJECT_VERSION}), openmpi-bin")
set(CPACK_DEBIAN_MPI_DESCRIPTION "laboratory for reaching movements: studies on clusters
The program reach-mpi spreads a study of virtual subjects over the ranks of an
OpenMPI job; its bytes are those of reach study on one computer.")
set(CPACK_DEBIAN_GUI_PACKAGE_NAME reachlab)
set(CPACK_DEBIAN_GUI_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_GUI_PACKAGE_DEPENDS "reachlab-cli (= ${PROJECT_VERSION}), libqt5svg5, libgl1-mesa-dri, fonts-dejavu-core")
set(CPACK_DEBIAN_GUI_PACKAGE_RECOMMENDS "libqt5multimedia5-plugins, fonts-ipafont-gothic, reachlab-doc")
set(CPACK_DEBIAN_GUI_PACKAGE_SUGGESTS "xwayland")
set(CPACK_DEBIAN_GUI_DESCRIPTION "laboratory for reaching movements: window
A person holds a force device or a mouse and moves masses and springs that
are bound to a curve, a surface or nothing. The window shows the scene, a
semaphore and live velocity profiles with predictions; every trial is judged
and recorded so that it cannot be lost.")
set(CPACK_DEBIAN_DOC_PACKAGE_NAME reachlab-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_DESCRIPTION "laboratory for reaching movements: manual
Tutorial, how to make each figure and table of the paper that the program
implements, reference of experiment, plan and definition files, recordings,
analysis and predictions, as pages that need no network.")
include(CPack)
