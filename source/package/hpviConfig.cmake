# SPDX-License-Identifier: LGPL-2.1-or-later
# find_package(hpvi): the target hpvi::hpvi, and what it links.
include(CMakeFindDependencyMacro)
list(PREPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})
find_dependency(deal.II 9.4)
find_dependency(CHOLMOD)
find_dependency(muparser)
find_dependency(ZLIB)
list(POP_FRONT CMAKE_MODULE_PATH)
include(${DEAL_II_TARGET_CONFIG})
include(${CMAKE_CURRENT_LIST_DIR}/hpviTargets.cmake)
