# SPDX-License-Identifier: MIT
# Runs EXAMPLE, which checks its own results, and looks for WORDS and for the picture that it wrote.
file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH})
execute_process(COMMAND ${EXAMPLE} picture.png WORKING_DIRECTORY ${SCRATCH}
    RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(NOT result EQUAL 0 OR NOT said MATCHES "${WORDS}")
    message(FATAL_ERROR "${EXAMPLE} ended with ${result} and said:\n${said}")
endif()
file(READ ${SCRATCH}/picture.png signature LIMIT 8 HEX)
if(NOT signature STREQUAL "89504e470d0a1a0a")
    message(FATAL_ERROR "${EXAMPLE} wrote no picture")
endif()
execute_process(COMMAND ${EXAMPLE} none/picture.png WORKING_DIRECTORY ${SCRATCH}
    RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(NOT result EQUAL 1 OR NOT said MATCHES "none/picture.png: it cannot be written")
    message(FATAL_ERROR "${EXAMPLE} ended with ${result} for a picture in no folder:\n${said}")
endif()
