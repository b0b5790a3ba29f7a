# Several sources as one, so that what they include is read once and its templates are instantiated once: what builds
# without ccache do. CMake's own unity builds know neither options of single files nor names that are the same.

# join(RESULT NAME SIZE SOURCE...): files that include SIZE sources each.
function(join result name size)
  set(all "")
  while(ARGN)
    list(SUBLIST ARGN 0 ${size} batch)
    list(REMOVE_ITEM ARGN ${batch})
    list(LENGTH all i)
    set(file ${CMAKE_CURRENT_BINARY_DIR}/joined/${name}_${i}.cc)
    list(TRANSFORM batch REPLACE "(.+)" "#include \"\\1\"\n")
    list(JOIN batch "" text)
    file(CONFIGURE OUTPUT ${file} CONTENT "${text}" @ONLY)
    list(APPEND all ${file})
  endwhile()
  set(${result} ${all} PARENT_SCOPE)
endfunction()

# join_tests(RESULT NAME SIZE SOURCE...): the same for tests, by JoinTests.cmake.
function(join_tests result name size)
  set(script ${PROJECT_SOURCE_DIR}/cmake/JoinTests.cmake)
  set(all "")
  while(ARGN)
    list(SUBLIST ARGN 0 ${size} batch)
    list(REMOVE_ITEM ARGN ${batch})
    list(LENGTH all i)
    set(file ${CMAKE_CURRENT_BINARY_DIR}/joined/${name}_${i}.cc)
    list(GET batch 0 first)
    get_filename_component(folder ${first} DIRECTORY)
    list(JOIN batch : sources)
    add_custom_command(OUTPUT ${file} DEPENDS ${batch} ${script}
      COMMAND ${CMAKE_COMMAND} -DOUT=${file} -DSOURCES=${sources} -P ${script} COMMENT "" VERBATIM)
    set_source_files_properties(${file} PROPERTIES INCLUDE_DIRECTORIES ${folder})
    list(APPEND all ${file})
  endwhile()
  set(${result} ${all} PARENT_SCOPE)
endfunction()
