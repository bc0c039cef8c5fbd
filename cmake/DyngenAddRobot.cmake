# SPDX-License-Identifier: MIT
#[[
dyngen_add_robot(<target> ROBOT file   # .robot, URDF, MJCF or SYMORO's .par
  [BASE link] [TIP link]          # of URDF and MJCF: the chain between them
  [ROUND_ANGLES tol]              # of URDF and MJCF, rad: 1e-4 makes 1.5708 a right angle
  [FUNCTIONS name ...]            # default: all for one sample; name_batch: for many; all: both
  [PREFIX p]                      # begins every external name; default: <target>
  [PARAMETERS baked|runtime]      # default: baked
  [SCALAR double|float]           # default: double
  [TRIG inline|libm]              # sines and cosines; default: inline
  [GRAVITY file|runtime]          # default: file
  [WRENCH] [PAYLOAD]              # arguments of the functions: a wrench, a body on the last link
  [WRENCH_LINK number|name]       # the link of the wrench, which is then an argument
  [NO_REGROUP]                    # keep the standard parameters
  [EFFECTS dir ...]               # folders of more effects, files NAME.effect
  [FOLD]                          # with PARAMETERS runtime: functions read what <prefix>_fold makes of chi
  [CPP_WRAPPER]                   # <target>.hpp too: the functions over Eigen's types, C++20
  [OUTPUT_DIR dir]                # in the build tree; default: dyngen/<target>
  [GENERATOR exe]                 # a program or a target that runs on this machine
  [CHECKED_IN dir])               # in the source tree: committed copies of <target>.c, <target>.h

Makes the static library <target> from <target>.c and <target>.h, which dyngen writes from the robot
file during the build, again whenever the file, one of its effect files or the generator changes. Whoever links <target> finds
<target>.h, and with CPP_WRAPPER <target>.hpp and Eigen. ROBOT, EFFECTS, GENERATOR and CHECKED_IN are relative to the current source directory, OUTPUT_DIR to
the current binary directory.

The generator is GENERATOR, else the variable DYNGEN_EXECUTABLE, else the target dyngen::dyngen, which
does not serve when cross-compiling. If there is none, the files in CHECKED_IN are compiled.

With CHECKED_IN the target <target>_regenerate copies what dyngen writes there. Nothing else touches
the source tree.
]]

# The policies of the functions below, whatever the project that uses them asks for.
cmake_policy(PUSH)
cmake_policy(VERSION 3.20...3.25)

function(dyngen_add_robot target)
  set(flags WRENCH PAYLOAD NO_REGROUP FOLD CPP_WRAPPER)
  set(one_value ROBOT BASE TIP ROUND_ANGLES PREFIX PARAMETERS SCALAR TRIG GRAVITY WRENCH_LINK OUTPUT_DIR
    GENERATOR CHECKED_IN)
  cmake_parse_arguments(PARSE_ARGV 1 arg "${flags}" "${one_value}" "FUNCTIONS;EFFECTS")
  set(where "dyngen_add_robot(${target})")

  # What was asked for.
  if(arg_KEYWORDS_MISSING_VALUES)
    list(GET arg_KEYWORDS_MISSING_VALUES 0 keyword)
    message(FATAL_ERROR "${where}: ${keyword} needs a value")
  endif()
  if(arg_UNPARSED_ARGUMENTS)
    list(GET arg_UNPARSED_ARGUMENTS 0 word)
    list(JOIN one_value ", " expected)
    list(JOIN flags ", " expected_flags)
    message(FATAL_ERROR
      "${where}: unknown argument '${word}'; expected ${expected}, ${expected_flags}, FUNCTIONS, EFFECTS")
  endif()
  if(TARGET ${target})
    message(FATAL_ERROR "${where}: a target of this name exists already")
  endif()
  if(NOT DEFINED arg_ROBOT)
    message(FATAL_ERROR "${where}: ROBOT is missing; it names the robot file")
  endif()
  get_filename_component(robot "${arg_ROBOT}" ABSOLUTE)
  if(NOT EXISTS "${robot}" OR IS_DIRECTORY "${robot}")
    message(FATAL_ERROR "${where}: ROBOT: there is no file '${robot}'")
  endif()
  # fk_3 is fk of link 3; id_batch is id over many samples
  set(functions ${arg_FUNCTIONS})
  list(TRANSFORM functions REPLACE "_batch$" "")
  list(TRANSFORM functions REPLACE "^(fk|jacobian|external_torque)_[1-9][0-9]*$" "\\1")
  _dyngen_check_choice(FUNCTIONS functions all id id_rigid gravity coriolis friction effects mass_matrix
    coriolis_matrix coriolis_matrix_fast fd regressor base_regressor base_regressor_gradient gravity_regressor
    energy_regressor power id_dq_pos id_dq id_ddq id_derivatives fk jacobian external_torque com com_jacobian
    momentum)
  _dyngen_check_choice(PARAMETERS arg_PARAMETERS baked runtime)
  _dyngen_check_choice(SCALAR arg_SCALAR double float)
  _dyngen_check_choice(TRIG arg_TRIG inline libm)
  _dyngen_check_choice(GRAVITY arg_GRAVITY file runtime)
  set(identifier "^[A-Za-z_][A-Za-z0-9_]*$")
  if(DEFINED arg_PREFIX AND NOT arg_PREFIX MATCHES "${identifier}")
    message(FATAL_ERROR "${where}: PREFIX: '${arg_PREFIX}' is not a C identifier; "
      "expected letters, digits and '_', no digit first")
  elseif(NOT DEFINED arg_PREFIX AND NOT target MATCHES "${identifier}")
    message(FATAL_ERROR "${where}: PREFIX is missing; "
      "the target's name cannot stand for it, it is not a C identifier")
  elseif(NOT DEFINED arg_PREFIX)
    set(arg_PREFIX ${target})
  endif()

  set(effects "")
  foreach(folder IN LISTS arg_EFFECTS)
    get_filename_component(folder "${folder}" ABSOLUTE)
    if(NOT IS_DIRECTORY "${folder}")
      message(FATAL_ERROR "${where}: EFFECTS: there is no folder '${folder}'")
    endif()
    list(APPEND effects "${folder}")
  endforeach()

  # Where the files are.
  if(NOT DEFINED arg_OUTPUT_DIR)
    set(arg_OUTPUT_DIR dyngen/${target})
  endif()
  get_filename_component(output "${arg_OUTPUT_DIR}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_BINARY_DIR}")
  if(DEFINED arg_CHECKED_IN)
    get_filename_component(checked_in "${arg_CHECKED_IN}" ABSOLUTE)
    if(output STREQUAL checked_in)
      message(FATAL_ERROR "${where}: OUTPUT_DIR and CHECKED_IN are the same directory; "
        "the build does not write into the source tree")
    endif()
  endif()
  _dyngen_claim("${where}" "${output}/${target}")
  _dyngen_find_generator(generator generator_file)
  if(generator)
    set(files_dir "${output}")
  elseif(NOT DEFINED arg_CHECKED_IN)
    set(reason "none is installed")
    if(CMAKE_CROSSCOMPILING)
      set(reason "dyngen::dyngen does not run here when cross-compiling")
    endif()
    message(FATAL_ERROR "${where}: there is no generator (${reason}); "
      "set GENERATOR or DYNGEN_EXECUTABLE to a dyngen of this machine, or give CHECKED_IN")
  elseif(NOT EXISTS "${checked_in}/${target}.c" OR NOT EXISTS "${checked_in}/${target}.h")
    message(FATAL_ERROR "${where}: CHECKED_IN: there is no generator, and no ${target}.c and "
      "${target}.h in '${checked_in}'")
  elseif(arg_CPP_WRAPPER AND NOT EXISTS "${checked_in}/${target}.hpp")
    message(FATAL_ERROR "${where}: CHECKED_IN: there is no generator, and no ${target}.hpp in "
      "'${checked_in}'")
  else()
    set(files_dir "${checked_in}")
  endif()
  set(source "${files_dir}/${target}.c")
  set(headers "${files_dir}/${target}.h")
  if(arg_CPP_WRAPPER)
    list(APPEND headers "${files_dir}/${target}.hpp")
    find_package(Eigen3 QUIET NO_MODULE)
    if(NOT TARGET Eigen3::Eigen)
      message(FATAL_ERROR "${where}: CPP_WRAPPER needs Eigen (libeigen3-dev), which is not found")
    endif()
  endif()

  if(generator)
    set(options --prefix ${arg_PREFIX})
    if(DEFINED arg_FUNCTIONS)
      list(JOIN arg_FUNCTIONS "," functions)
      list(APPEND options --functions ${functions})
    endif()
    foreach(keyword IN ITEMS BASE TIP ROUND_ANGLES PARAMETERS SCALAR TRIG GRAVITY)
      if(DEFINED arg_${keyword})
        string(TOLOWER ${keyword} option)
        string(REPLACE "_" "-" option ${option})
        list(APPEND options --${option} ${arg_${keyword}})
      endif()
    endforeach()
    foreach(flag IN LISTS flags)
      if(arg_${flag})
        string(TOLOWER ${flag} option)
        string(REPLACE "_" "-" option ${option})
        list(APPEND options --${option})
      endif()
    endforeach()
    if(DEFINED arg_WRENCH_LINK)
      list(REMOVE_ITEM options --wrench)
      list(APPEND options "--wrench=${arg_WRENCH_LINK}")
    endif()
    foreach(folder IN LISTS effects)
      list(APPEND options --effects "${folder}")
    endforeach()
    file(MAKE_DIRECTORY "${output}")
    get_filename_component(robot_name "${robot}" NAME)
    add_custom_command(
      OUTPUT "${source}" ${headers}
      COMMAND ${generator} "${robot}" -o "${source}" ${options} --depfile "${source}.d"
      DEPENDS "${robot}" "${generator_file}"
      DEPFILE "${source}.d"
      COMMENT "Generating ${target}.c and ${target}.h from ${robot_name}"
      VERBATIM)
    # One target owns the command, so that parallel Make runs it once.
    add_custom_target(${target}_generate DEPENDS "${source}" ${headers})
  endif()

  # The library.
  add_library(${target} STATIC "${source}" ${headers})
  set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)  # what is emitted is compiled alone
  target_include_directories(${target} PUBLIC "$<BUILD_INTERFACE:${files_dir}>")
  set_target_properties(${target} PROPERTIES PUBLIC_HEADER "${headers}")
  get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
  if(C IN_LIST languages)
    target_compile_features(${target} PUBLIC c_std_99)
  else()  # a project of C++ alone: the code is C++ too
    set_source_files_properties("${source}" PROPERTIES LANGUAGE CXX)
  endif()
  # gcc packs pairs of scalar products into registers of two, which costs more moves than it saves
  target_compile_options(${target} PRIVATE
    $<$<OR:$<COMPILE_LANG_AND_ID:C,GNU>,$<COMPILE_LANG_AND_ID:CXX,GNU>>:-fno-tree-slp-vectorize>)
  if(NOT WIN32)
    target_link_libraries(${target} PUBLIC m)
  endif()
  if(arg_CPP_WRAPPER)
    target_link_libraries(${target} INTERFACE Eigen3::Eigen)
    if(CXX IN_LIST languages)
      target_compile_features(${target} INTERFACE cxx_std_20)
    endif()
  endif()

  if(generator)
    add_dependencies(${target} ${target}_generate)
  endif()
  if(DEFINED arg_CHECKED_IN)
    if(generator)
      add_custom_target(${target}_regenerate
        COMMAND ${CMAKE_COMMAND} -E make_directory "${checked_in}"
        COMMAND ${CMAKE_COMMAND} -E copy_if_different "${source}" ${headers} "${checked_in}"
        COMMENT "Writing ${target}.c and ${target}.h to ${checked_in}"
        VERBATIM)
      add_dependencies(${target}_regenerate ${target}_generate)
    else()
      add_custom_target(${target}_regenerate
        COMMAND ${CMAKE_COMMAND} -E echo "${target}_regenerate: there is no generator"
        COMMAND ${CMAKE_COMMAND} -E false
        VERBATIM)
    endif()
  endif()
endfunction()

# Stops unless each word of the list variable is one of the words that follow. Uses the caller's `where`.
function(_dyngen_check_choice keyword variable)
  foreach(word IN LISTS ${variable})
    if(NOT word IN_LIST ARGN)
      list(JOIN ARGN ", " expected)
      message(FATAL_ERROR "${where}: ${keyword}: unknown value '${word}'; expected ${expected}")
    endif()
  endforeach()
endfunction()

# Stops if another robot has this output path. Letter case does not tell two robots apart: not in the
# macros of their headers, not on every file system.
function(_dyngen_claim where path)
  string(TOLOWER "${path}" key)
  get_property(taken GLOBAL PROPERTY _dyngen_output_paths)
  if(key IN_LIST taken)
    message(FATAL_ERROR "${where}: another robot writes the same files, ${path}.c and .h "
      "(letter case does not count)")
  endif()
  set_property(GLOBAL APPEND PROPERTY _dyngen_output_paths "${key}")
endfunction()

# The command of the generator and the file (or target) on which its output depends; empty if there is
# none. Uses the caller's `where` and `arg_GENERATOR`.
function(_dyngen_find_generator command file)
  set(${command} "" PARENT_SCOPE)
  set(${file} "" PARENT_SCOPE)
  if(DEFINED arg_GENERATOR)
    set(name GENERATOR)
    set(value "${arg_GENERATOR}")
  elseif(DYNGEN_EXECUTABLE)
    set(name DYNGEN_EXECUTABLE)
    set(value "${DYNGEN_EXECUTABLE}")
  elseif(TARGET dyngen::dyngen AND NOT CMAKE_CROSSCOMPILING)
    set(value dyngen::dyngen)
  else()
    return()
  endif()
  if(TARGET "${value}")
    set(${command} "$<TARGET_FILE:${value}>" PARENT_SCOPE)
    set(${file} "${value}" PARENT_SCOPE)
    return()
  endif()
  get_filename_component(path "${value}" ABSOLUTE)
  if(NOT EXISTS "${path}" AND NOT value MATCHES "/")  # a bare name: look along PATH, on this machine
    unset(path)
    find_program(path "${value}" NO_CACHE NO_CMAKE_FIND_ROOT_PATH)
  endif()
  if(NOT path OR NOT EXISTS "${path}" OR IS_DIRECTORY "${path}")
    message(FATAL_ERROR "${where}: ${name}: there is no program '${value}'")
  endif()
  set(${command} "${path}" PARENT_SCOPE)
  set(${file} "${path}" PARENT_SCOPE)
endfunction()

cmake_policy(POP)
