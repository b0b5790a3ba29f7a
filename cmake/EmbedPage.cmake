# The report page: web/ is built into one HTML file, and that is embedded into the program.
#
# TOURMALINE_PAGE names a page that was built elsewhere, for machines that cannot reach the npm registry.

set(TOURMALINE_PAGE "" CACHE FILEPATH "a report page built elsewhere; empty: build it from web/")

function(embed_page target)
  if(TOURMALINE_PAGE)
    set(page ${TOURMALINE_PAGE})
  else()
    build_page(page)
  endif()
  set(assembly ${CMAKE_CURRENT_BINARY_DIR}/page.S)
  file(CONFIGURE OUTPUT ${assembly} @ONLY CONTENT [[
    .section .rodata
    .global tourmaline_report_page
    .global tourmaline_report_page_end
tourmaline_report_page:
    .incbin "@page@"
tourmaline_report_page_end:
    .byte 0
    .section .note.GNU-stack,"",%progbits
]])
  set_source_files_properties(${assembly} PROPERTIES OBJECT_DEPENDS ${page} COMPILE_OPTIONS "-Wno-all")
  target_sources(${target} PRIVATE ${assembly})
endfunction()

function(build_page result)
  find_program(NPM npm)
  if(NOT NPM)
    message(FATAL_ERROR "The report page needs Node.js and npm to be built, and npm is not here. "
      "`./dev setup` installs both. Or give a page built elsewhere: -DTOURMALINE_PAGE=FILE")
  endif()
  set(web ${PROJECT_SOURCE_DIR}/web)
  set(page ${PROJECT_BINARY_DIR}/web/index.html)
  file(GLOB sources CONFIGURE_DEPENDS ${web}/src/*.ts ${web}/src/*.css)
  add_custom_command(OUTPUT ${page}
    COMMAND ${CMAKE_COMMAND} -DNPM=${NPM} -DWEB=${web} -DOUT=${PROJECT_BINARY_DIR}/web
            -P ${PROJECT_SOURCE_DIR}/cmake/BuildPage.cmake
    DEPENDS ${sources} ${web}/index.html ${web}/vite.config.ts ${web}/tsconfig.json ${web}/package.json
            ${web}/package-lock.json ${PROJECT_SOURCE_DIR}/cmake/BuildPage.cmake
    COMMENT "Building the report page" VERBATIM)
  set(${result} ${page} PARENT_SCOPE)
endfunction()
