# find_package(fluxwalk) -> fluxwalk::core. The library is static, so what it is made of is needed to link.
include(CMakeFindDependencyMacro)
find_dependency(glm)
find_dependency(embree 3)
find_dependency(TBB)
find_dependency(TinyGLTF)
find_dependency(fmt)
find_dependency(OpenEXR)
include(${CMAKE_CURRENT_LIST_DIR}/fluxwalkTargets.cmake)
