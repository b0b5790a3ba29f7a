set(documents ${CMAKE_INSTALL_DATADIR}/doc/tourmaline)
set(made ${CMAKE_CURRENT_BINARY_DIR})

install(TARGETS tourmaline COMPONENT program)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/cases DESTINATION ${CMAKE_INSTALL_DATADIR}/tourmaline COMPONENT program)

# The built-in materials, as a file that a user copies and changes. Their text is in the program's source.
set(source ${PROJECT_SOURCE_DIR}/src/material/library_text.cc)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
file(READ ${source} text)
if(NOT text MATCHES "R\"toml\\(\n(.*)\\)toml\"")
  message(FATAL_ERROR "${source}: the text of the materials, R\"toml(...)toml\", is not there")
endif()
file(WRITE ${made}/materials.toml "# The built-in materials of tourmaline ${PROJECT_VERSION}, in SI units. To change "
  "one, copy this file and name the copy\n# in the case: material.file = \"materials.toml\".\n\n${CMAKE_MATCH_1}")
install(FILES ${made}/materials.toml DESTINATION ${CMAKE_INSTALL_DATADIR}/tourmaline COMPONENT program)

# README.md and docs/ beside each other, as in the source, so that their links hold.
install(FILES ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${documents} COMPONENT program)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${documents} COMPONENT program
  FILES_MATCHING REGEX "[.](md|png|svg|json)$")
install(FILES ${PROJECT_SOURCE_DIR}/bench/results.md DESTINATION ${documents}/bench COMPONENT program)
file(CREATE_LINK ../../tourmaline/cases ${made}/cases SYMBOLIC)
install(FILES ${made}/cases DESTINATION ${documents} COMPONENT program)

# Completion knows commands, options and keys of the case file from the program itself.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
foreach(shell bash zsh)
  add_custom_command(OUTPUT ${made}/completion.${shell}
    COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/completion.py ${shell} $<TARGET_FILE:tourmaline>
            ${made}/completion.${shell}
    DEPENDS tourmaline completion.py completion.${shell}.in VERBATIM)
endforeach()
install(FILES ${made}/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  RENAME tourmaline COMPONENT program)
install(FILES ${made}/completion.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions
  RENAME _tourmaline COMPONENT program)

# -n: neither name nor time in the compressed file.
find_program(GZIP gzip REQUIRED)
add_custom_command(OUTPUT ${made}/tourmaline.1.gz
  COMMAND sh -c "${GZIP} -9nc < '${CMAKE_CURRENT_SOURCE_DIR}/tourmaline.1' > '${made}/tourmaline.1.gz'"
  DEPENDS tourmaline.1 VERBATIM)
install(FILES ${made}/tourmaline.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)

# All that is installed, without the tests.
add_custom_target(installed ALL DEPENDS tourmaline ${made}/completion.bash ${made}/completion.zsh
  ${made}/tourmaline.1.gz)
