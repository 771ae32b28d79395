# SPDX-License-Identifier: MIT
# Runs DOXYGEN on DOXYFILE, whose output is FOLDER; warnings are errors. All that is public has words
# of its own, deduction guides apart.
file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
execute_process(COMMAND ${DOXYGEN} ${DOXYFILE} RESULT_VARIABLE result)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "${DOXYGEN} ended with ${result}")
endif()
if(NOT EXISTS ${FOLDER}/html/index.html)
    message(FATAL_ERROR "${DOXYGEN} wrote no ${FOLDER}/html/index.html")
endif()
file(STRINGS ${FOLDER}/warnings.txt warnings)
list(FILTER warnings EXCLUDE REGEX "Member .*\\) -> .* is not documented")
if(warnings)
    list(JOIN warnings "\n" warnings)
    message(FATAL_ERROR "Doxygen warns:\n${warnings}")
endif()
