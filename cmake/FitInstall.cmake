# Install tree, build tree and the package file that find_package(GarmentFit) reads.
include(CMakePackageConfigHelpers)

set(GARMENTFIT_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/GarmentFit)

install(EXPORT GarmentFit NAMESPACE GarmentFit:: FILE GarmentFitTargets.cmake DESTINATION ${GARMENTFIT_PACKAGE_DIR})
export(EXPORT GarmentFit NAMESPACE GarmentFit:: FILE ${PROJECT_BINARY_DIR}/GarmentFitTargets.cmake)

configure_package_config_file(cmake/GarmentFitConfig.cmake.in ${PROJECT_BINARY_DIR}/GarmentFitConfig.cmake
                              INSTALL_DESTINATION ${GARMENTFIT_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/GarmentFitConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/GarmentFitConfig.cmake ${PROJECT_BINARY_DIR}/GarmentFitConfigVersion.cmake
        DESTINATION ${GARMENTFIT_PACKAGE_DIR})
# where Debian's packages have it
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/garmentfit RENAME copyright)
