# Writes ${OUT} with the commit of the source tree at ${SOURCE}, as far as git knows it; leaves the file alone when it says so
# already.
if(NOT EXISTS ${SOURCE}/.git)
  set(failed TRUE)  # perhaps within the folders of another project
else()
execute_process(COMMAND git -C ${SOURCE} describe --always --abbrev=12 --exclude=* --dirty=+changes
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
endif()
if(failed)
  set(commit "")
endif()
set(text "#pragma once\n#define REAM_BUILD_COMMIT \"${commit}\"\n")
if(EXISTS ${OUT})
  file(READ ${OUT} before)
endif()
if(NOT "${before}" STREQUAL "${text}")
  file(WRITE ${OUT} "${text}")
endif()
