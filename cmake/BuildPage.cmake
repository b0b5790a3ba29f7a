# cmake -DNPM=... -DWEB=<web folder> -DOUT=<folder of the page> -P BuildPage.cmake

# Builds of several kinds share web/node_modules.
file(LOCK ${WEB}/.build-lock GUARD PROCESS TIMEOUT 300)
set(installed ${WEB}/node_modules/.package-lock.json)
if(NOT EXISTS ${installed} OR ${WEB}/package-lock.json IS_NEWER_THAN ${installed})
  # Not `npm ci`, which refuses a lock file without the optional packages of other platforms.
  execute_process(COMMAND ${NPM} install --no-save --ignore-scripts --no-audit --no-fund --loglevel=error
    WORKING_DIRECTORY ${WEB} RESULT_VARIABLE failed OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(failed)
    message(FATAL_ERROR "${text}\nThe packages of the report page (web/package-lock.json) could not be "
      "fetched with npm. Without a way to the npm registry, give a page built elsewhere: "
      "-DTOURMALINE_PAGE=FILE")
  endif()
  file(TOUCH ${installed})
endif()
set(ENV{TOURMALINE_PAGE_FOLDER} ${OUT})
execute_process(COMMAND ${NPM} run --silent build WORKING_DIRECTORY ${WEB}
  RESULT_VARIABLE failed OUTPUT_VARIABLE text ERROR_VARIABLE text)
if(failed)
  message(FATAL_ERROR "${text}\nThe report page could not be built.")
endif()
