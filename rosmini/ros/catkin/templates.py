"""Templates for the files of a new package and of a new workspace."""

MANIFEST_XML = """<?xml version="1.0"?>
<package format="2">
  <name>{name}</name>
  <version>{version}</version>
  <description>{description}</description>

  <!-- Who looks after the package: at least one, each in a tag of its own -->
{maintainers}

  <!-- Under which licence others may use it, such as BSD, MIT or Apache-2.0: at least one -->
{licenses}

  <!-- Where to read more, and to report faults; type is website, repository or bugtracker -->
  <!-- <url type="website">http://wiki.ros.org/{name}</url> -->

  <!-- Who wrote it -->
{authors}
  <!-- What it needs. These are the tags:
       buildtool_depend     a tool of the build: catkin
       build_depend         while it is built, such as message_generation
       build_export_depend  while packages that use it are built
       exec_depend          while it runs, such as message_runtime
       depend               all three of the last at once
       test_depend          for its tests only
       doc_depend           for its documentation only -->
{depends}

  <!-- What it tells other tools -->
  <export>
{export}
  </export>
</package>
"""

CMAKE_LISTS = """cmake_minimum_required(VERSION 3.0.2)
project({name})

## catkin, and the packages that this one needs while it is built.
## Each is also in a *depend tag of package.xml.
{components}

## Libraries of the system
{boost}

## Python modules of this package (in src/{name}) that other packages import are described in a setup.py.
# catkin_python_setup()

## Messages, services and actions ##############################################
##
## 1. Write NAME.msg into the folder msg, NAME.srv into srv, NAME.action into action.
## 2. In package.xml, add <build_depend>message_generation</build_depend>,
##    <exec_depend>message_runtime</exec_depend>, and a <depend> for each package whose types are used.
## 3. Add message_generation, and these packages, to find_package above.
## 4. Take the # away from the blocks below that are needed, and name the files in them.

## Messages, in msg
# add_message_files(
#   FILES
#   Message1.msg
#   Message2.msg
# )

## Services, in srv
# add_service_files(
#   FILES
#   Service1.srv
#   Service2.srv
# )

## Actions, in action
# add_action_files(
#   FILES
#   Action1.action
#   Action2.action
# )

## Generate them; DEPENDENCIES are the packages whose types they use
# generate_messages(
#   DEPENDENCIES
{types}
# )

## Parameters that can be changed while a node runs, in cfg
# generate_dynamic_reconfigure_options(
#   cfg/Parameters1.cfg
# )

## What packages that use this one need ########################################
catkin_package(
#  INCLUDE_DIRS include
#  LIBRARIES {name}
#  CATKIN_DEPENDS {exported}
#  DEPENDS system_lib
)

## C++ #########################################################################
include_directories(
# include
  ${{catkin_INCLUDE_DIRS}}
)

# add_library(${{PROJECT_NAME}} src/{name}.cpp)
# add_executable(${{PROJECT_NAME}}_node src/{name}_node.cpp)
# target_link_libraries(${{PROJECT_NAME}}_node ${{catkin_LIBRARIES}})

## What is installed ###########################################################

## Scripts; their first line is made to name the right Python
# catkin_install_python(PROGRAMS
#   scripts/my_script.py
#   DESTINATION ${{CATKIN_PACKAGE_BIN_DESTINATION}}
# )

# install(TARGETS ${{PROJECT_NAME}}_node
#   RUNTIME DESTINATION ${{CATKIN_PACKAGE_BIN_DESTINATION}}
# )

# install(DIRECTORY launch
#   DESTINATION ${{CATKIN_PACKAGE_SHARE_DESTINATION}}
# )

## Tests #######################################################################
# if(CATKIN_ENABLE_TESTING)
#   find_package(rostest REQUIRED)
#   add_rostest(test/my.test)
#   catkin_add_nosetests(test)
# endif()
"""

METAPACKAGE_CMAKE = """cmake_minimum_required(VERSION 3.0.2)
project({name})
find_package(catkin REQUIRED)
catkin_metapackage()
"""

WORKSPACE_CMAKE = """# Made by rosmini's catkin_init_workspace, for real catkin; rosmini does not read it.
cmake_minimum_required(VERSION 3.0.2)
project(Project)
set(CATKIN_TOPLEVEL TRUE)
set(CATKIN_TOPLEVEL_FIND_PACKAGE TRUE)
find_package(catkin REQUIRED NO_POLICY_SCOPE)
unset(CATKIN_TOPLEVEL_FIND_PACKAGE)
catkin_workspace()
"""
