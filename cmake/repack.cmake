# SPDX-License-Identifier: MIT
# CPack runs this behind each kind of package. Its tarballs keep the order of the disk and the owner
# of the build: here they are packed again, by name and owned by root.
if(NOT CPACK_PACKAGE_FILES MATCHES "[.]tar[.]gz$")
    return()
endif()
find_program(tar NAMES gtar tar)
find_program(gzip gzip)
cmake_path(GET CPACK_TEMPORARY_DIRECTORY PARENT_PATH around)
cmake_path(GET CPACK_TEMPORARY_DIRECTORY FILENAME folder)
execute_process(COMMAND ${tar} --sort=name --owner=0 --group=0 --numeric-owner --format=gnu
                        --mode=u+rw,go+r,go-w,a+X --mtime=@$ENV{SOURCE_DATE_EPOCH}
                        -C ${around} -cf - ${folder}
                COMMAND ${gzip} -9n OUTPUT_FILE ${CPACK_PACKAGE_FILES}
                COMMAND_ERROR_IS_FATAL ANY)
