# The command line: exit codes, messages, and no file where something went wrong.
include(${CMAKE_CURRENT_LIST_DIR}/../script.cmake)
set(puma ${SOURCE_DIR}/robots/puma560.robot)
set(robot ${SOURCE_DIR}/robots/planar2r.robot)  # written in a tenth of the Puma's time

# The main use: a source of any of the four endings, and its header beside it.
foreach(ending IN ITEMS c cc cpp cxx)
  file(MAKE_DIRECTORY ${WORK}/${ending})
  run(text 0 ${DYNGEN} ${robot} -o ${ending}/arm.${ending})
  expect_files("-o arm.${ending}" ${WORK}/${ending} arm.${ending} arm.h)
  expect_text("-o arm.${ending}" "[${text}]" "[]")
  file(READ ${WORK}/${ending}/arm.${ending} source)
  expect_text("arm.${ending}" "${source}" "#include \"arm.h\"" "void planar2r_id(" "planar2r_gravity(")
endforeach()
run(text 0 ${DYNGEN} robots/planar2r.robot --prefix left --functions gravity,id -o /dev/null/../x.c
  --help)  # help comes before everything else
expect_text(--help "${text}" Usage --functions --parameters --scalar --prefix --depfile --count)
run(text 0 ${DYNGEN} --version)
expect_text(--version "${text}" "dyngen 0.")

# Options reach the code.
run(text 0 ${DYNGEN} ${robot} -o options.c --prefix left
  --functions gravity,coriolis --scalar float --parameters runtime)
file(READ ${WORK}/options.h header)
expect_text(options.h "${header}" "void left_gravity(const float *q, const float *chi, float *tau);"
  "left_coriolis(" "LEFT_NQ 2")
expect_no_text(options.h "${header}" planar2r_ left_id left_friction)
run(text 0 ${DYNGEN} ${robot} -o all.c --functions all)
file(READ ${WORK}/all.h header)
expect_text(all.h "${header}" planar2r_id planar2r_gravity planar2r_coriolis planar2r_friction)

# The C++ header stands beside the other one, and the depfile names it.
file(MAKE_DIRECTORY ${WORK}/wrapper)
run(text 0 ${DYNGEN} ${robot} -o wrapper/arm.cpp --prefix arm --cpp-wrapper --depfile wrapper/arm.d)
expect_files(--cpp-wrapper ${WORK}/wrapper arm.cpp arm.d arm.h arm.hpp)
file(READ ${WORK}/wrapper/arm.hpp header)
expect_text(--cpp-wrapper "${header}" "#include \"arm.h\"" "namespace arm {"
  "inline Vector id(const Vector& q, const Vector& dq, const Vector& ddq) noexcept"
  "::arm_id(q.data(), dq.data(), ddq.data(), tau.data())")
file(READ ${WORK}/wrapper/arm.d rule)
expect_text("--depfile of three files" "${rule}" "/arm.cpp " "/arm.h " "/arm.hpp: ")

# Options may stand before the robot file.
run(text 0 ${DYNGEN} --functions id,gravity ${robot} -o before.c)

# --count needs no output file; the bounds are those of the literature.
run(text 0 ${DYNGEN} ${puma} --count)
expect_text(--count "${text}" "puma560: 6 joints" "id " "gravity " "538 478" "105n - 92" "94n - 86")
run(text 0 ${DYNGEN} ${robot} --count)
expect_text(--count "${text}" "118 102")

# The depfile: absolute paths, escaped as Make wants them.
set(odd "${WORK}/a folder \$ #1")
file(MAKE_DIRECTORY "${odd}")
file(COPY ${robot} DESTINATION "${odd}")
file(RELATIVE_PATH relative ${WORK} "${odd}")
run(text 0 ${DYNGEN} "${relative}/planar2r.robot" -o "${relative}/arm.c" --depfile rule.d)
file(READ ${WORK}/rule.d rule)
string(REPLACE "${WORK}" "" rule "${rule}")
set(escaped "/a\\ folder\\ $$\\ \\#1")
expect_text(--depfile "${rule}"
  "${escaped}/arm.c ${escaped}/arm.h: ${escaped}/planar2r.robot")

# What is wrong with the input or the output: exit 1, nothing written.
set(out ${WORK}/out)
function(refuse code what)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "" "ARGUMENTS;SAYS")
  file(REMOVE_RECURSE ${out})
  file(MAKE_DIRECTORY ${out}/header_is_folder.h ${out}/folder.c)
  run(text ${code} ${DYNGEN} ${arg_ARGUMENTS})
  expect_text("${what}" "${text}" ${arg_SAYS})
  expect_files("${what}" ${out} header_is_folder.h folder.c)
endfunction()

file(WRITE ${WORK}/empty.robot "")
file(WRITE ${WORK}/wrong.robot "number_link 2\nsigma 0 0\nal 0 0\nd 0 0.5 7\nth 0 0\nr 0 0\nstop\n")
file(WRITE ${WORK}/regular_file "")
execute_process(COMMAND ${CMAKE_COMMAND} -E env printf "number_link 1\\000\\001\\n"
  OUTPUT_FILE ${WORK}/binary.robot)
refuse(1 "missing file" ARGUMENTS none.robot -o out/x.c SAYS none.robot "No such file")
refuse(1 "a folder as robot" ARGUMENTS ${out} -o out/x.c SAYS "cannot read")
refuse(1 "empty file" ARGUMENTS empty.robot -o out/x.c SAYS "empty.robot:1:1: error:" "empty")
refuse(1 "binary file" ARGUMENTS binary.robot -o out/x.c SAYS "binary.robot:1:" "binary")
refuse(1 "wrong row" ARGUMENTS wrong.robot -o out/x.c --depfile out/x.d
  SAYS "wrong.robot:4:" "error:" "d 0 0.5 7" "^")
refuse(1 "wrong row with --count" ARGUMENTS wrong.robot --count SAYS "wrong.robot:4:")
refuse(1 "below a regular file" ARGUMENTS ${robot} -o regular_file/x.c
  SAYS "regular_file/x.c: error: cannot write")
refuse(1 "a folder that is not there" ARGUMENTS ${robot} -o out/none/x.c
  SAYS "out/none/x.c: error: cannot write")
refuse(1 "a folder as output" ARGUMENTS ${robot} -o out/folder.c
  SAYS "out/folder.c: error: cannot write")
refuse(1 "a folder as header" ARGUMENTS ${robot} -o out/header_is_folder.c
  SAYS "out/header_is_folder.h: error: cannot write")
refuse(1 "a depfile that cannot be written" ARGUMENTS ${robot} -o out/x.c --depfile out/none/x.d
  SAYS "out/none/x.d: error: cannot write")

# Numbers that the arithmetic cannot hold.
file(WRITE ${WORK}/large.robot "number_link 2\nd 0 1\nm 1 1e39\nZZ 1 1\ngy 9.81\nstop\n")
refuse(1 "too large for float" ARGUMENTS large.robot -o out/x.c --scalar float
  SAYS "large.robot: error: ZZR1" "too large for float")

# A function that the robot has not.
file(WRITE ${WORK}/weightless.robot "number_link 2\nd 0 1\nZZ 1 0\ngy 9.81\nstop\n")
refuse(1 "nothing moved" ARGUMENTS weightless.robot -o out/x.c --functions id,fd
  SAYS "weightless.robot: error: --functions: 'fd': joint 2" "neither mass nor rotor")

# Effects: those of the program and of a folder, which the depfile names; what cannot run is left out.
file(READ ${SOURCE_DIR}/robots/planar2r.robot text)
string(REPLACE "\nstop" "\neffect stribeck joint=2 Fs=3 vs=0.05\neffect base_tilt gx=0.1\neffect bump joint=1 a=2\nstop"
  text "${text}")
file(WRITE ${WORK}/effects.robot "${text}")
refuse(1 "an effect without its file" ARGUMENTS effects.robot -o out/x.c
  SAYS "effects.robot:40:8: error: unknown effect 'bump'")
file(MAKE_DIRECTORY ${WORK}/more)
file(WRITE ${WORK}/more/bump.effect "effect bump\nfamily torque_ripple\ntitle A bump\nkind algebraic\n"
  "scope joint\njoints revolute\nsource made up\nparameter a linear unit=torque start=1 typical=1 : its size\n"
  "torque a*sin(3*q)\nhidden nothing\nseparate nothing\nplot q\n")
run(text 0 ${DYNGEN} effects.robot -o effects.c --effects more --depfile effects.d
  --functions id,effects)
expect_text("an effect of the rigid model" "${text}"
  "effects.robot:39:8: warning: effect 'base_tilt' cannot run in a controller: it is made of derivatives of the rigid model; it is left out of the emitted functions")
file(READ ${WORK}/effects.h header)
expect_text(--effects "${header}" "Effects: stribeck of joint 2, bump of joint 1." "void planar2r_effects(")
file(READ ${WORK}/effects.d rule)
expect_text("--depfile with effects" "${rule}" "/effects.robot " "/more/bump.effect")
refuse(1 "no folder of effects" ARGUMENTS effects.robot -o out/x.c --effects nowhere
  SAYS "nowhere: error: the folder of effects cannot be read")
run(text 0 ${DYNGEN} effects.robot --effects more --count)
expect_text("--count with effects" "${text}" "div calls")

# Wrong usage: exit 2.
file(WRITE ${WORK}/robot.c "number_link 1\nZZ 1\ngy 9.81\nstop\n")
refuse(2 "the robot file as output" ARGUMENTS robot.c -o robot.c SAYS "same file")
refuse(2 "the output as depfile" ARGUMENTS ${robot} -o out/x.c --depfile out/x.c SAYS "same file")
refuse(2 "the header as depfile" ARGUMENTS ${robot} -o out/x.c --depfile out/x.h SAYS "same file")
refuse(2 "empty prefix" ARGUMENTS ${robot} -o out/x.c --prefix "" SAYS "--prefix")
refuse(2 "no arguments" SAYS robot --help)
refuse(2 "nothing to do" ARGUMENTS ${robot} SAYS "-o" "--count" "--explain")
run(text 0 ${DYNGEN} ${puma} --explain)
expect_text(--explain "${text}" "puma560: 6 joints" "ZZR2 = ZZ2 + IA2 + d3^2 (M3 + M4 + M5 + M6)" "d3 = 0.4318 m"
  "perpendicular" "only in sums" "Gravity alone")
expect_text(--explain "${text}" "turns about +y through (0.4318, 0.1501, 0)" "gravity pulls with 9.81 m/s^2 along -z0")

# The drawing: alone or beside other output; where it cannot be written nothing is.
run(text 0 ${DYNGEN} --explain ${puma} --drawing puma.svg)
expect_text("--explain --drawing" "${text}" "puma560: 6 joints")
file(READ ${WORK}/puma.svg drawing)
expect_text(--drawing "${drawing}" "<svg " "joint-6" "all joints at 0" "</svg>")
run(text 0 ${DYNGEN} ${puma} --drawing again.svg)
expect_text("--drawing alone" "[${text}]" "[]")
expect_same_file("two drawings" ${WORK}/puma.svg ${WORK}/again.svg)
refuse(1 "a drawing that cannot be written" ARGUMENTS ${robot} -o out/x.c --drawing out/none/x.svg
  SAYS "out/none/x.svg: error: cannot write")
refuse(2 "a drawing of another kind" ARGUMENTS ${robot} --drawing out/x.png SAYS --drawing ".svg")
refuse(2 "the robot file as drawing" ARGUMENTS arm.svg --drawing arm.svg SAYS "same file")
refuse(2 "unknown option" ARGUMENTS ${robot} -o out/x.c --frobnicate SAYS --frobnicate --help)
refuse(2 "unknown function" ARGUMENTS ${robot} -o out/x.c --functions id,inverse
  SAYS "--functions" "'inverse'" "gravity")
refuse(2 "frame of no link" ARGUMENTS ${puma} -o out/x.c --functions id,fk_7
  SAYS "--functions" "'fk_7'" "no link 7" "fk_1 to fk_6")
refuse(2 "wrong scalar" ARGUMENTS ${robot} -o out/x.c --scalar half SAYS --scalar half double float)
refuse(2 "wrong parameters" ARGUMENTS ${robot} -o out/x.c --parameters hot
  SAYS --parameters hot baked runtime)
refuse(2 "nothing to fold" ARGUMENTS ${robot} -o out/x.c --fold SAYS --fold "--parameters runtime")
refuse(2 "search backwards" ARGUMENTS ${robot} -o out/x.c --search -1 SAYS --search)
refuse(2 "wrong trig" ARGUMENTS ${robot} -o out/x.c --trig table SAYS --trig table inline libm)
refuse(2 "wrong prefix" ARGUMENTS ${robot} -o out/x.c --prefix 2arm SAYS --prefix "'2arm'")
refuse(2 "wrong ending" ARGUMENTS ${robot} -o out/x.txt SAYS "out/x.txt" ".cpp")
refuse(2 "depfile alone" ARGUMENTS ${robot} --count --depfile out/x.d SAYS --depfile)
refuse(2 "wrapper alone" ARGUMENTS ${robot} --count --cpp-wrapper SAYS --cpp-wrapper)
refuse(2 "the C++ header as depfile" ARGUMENTS ${robot} -o out/x.c --cpp-wrapper --depfile out/x.hpp
  SAYS "same file")
refuse(1 "a keyword as namespace" ARGUMENTS ${robot} -o out/x.c --cpp-wrapper --prefix class
  SAYS "planar2r.robot: error:" "'class'" --prefix)
refuse(2 "two robots" ARGUMENTS ${robot} ${robot} -o out/x.c SAYS planar2r.robot)

# A good file that was there before a failure is there after it.
file(WRITE ${WORK}/kept.c "kept")
run(text 1 ${DYNGEN} wrong.robot -o kept.c)
file(READ ${WORK}/kept.c kept)
if(NOT kept STREQUAL "kept")
  message(FATAL_ERROR "a failed run changed kept.c")
endif()

# Files that can be read but are hardly meant: warnings at their rows, and what was asked for.
set(cases ${SOURCE_DIR}/tests/data/cases)
run(text 0 ${DYNGEN} ${cases}/inertia_at_com/com.robot -o com.c)
expect_text("inertia at the centre of mass" "${text}" "com.robot:8:9: warning: 'ZZ' of link 2 is 0.02, below"
  "= 0.18" "given at the centre of mass?")
run(text 0 ${DYNGEN} ${cases}/millimetres/mm.robot --count)
expect_text(millimetres "${text}" "mm.robot:2:5: warning: 'd' of joint 2 is 450: a length of 450 m"
  "millimetres? write 0.45")
run(text 0 ${DYNGEN} ${cases}/pendulum_gradient/pend.robot --functions base_regressor_gradient -o pend.c)
expect_text("gradient of a pendulum" "[${text}]" "[]")
file(WRITE ${WORK}/nothing.robot "number_link 1\ngz 9.81\nstop\n")
run(text 0 ${DYNGEN} nothing.robot -o nothing.c)
expect_text("no mass at all" "${text}" "nothing.robot:3:1: warning: joint 1 carries neither mass nor inertia"
  "nothing.robot: warning: fd is left out: joint 1")
file(WRITE ${WORK}/friction.robot
  "number_link 1\nm 1\nmX 0.1\nZZ 1\nFs 2\ngy 9.81\neffect stribeck joint=1 Fs=1 vs=0.1\nstop\n")
run(text 0 ${DYNGEN} friction.robot -o friction.c)
expect_text("Fs below Coulomb friction" "${text}" "friction.robot:7:28: warning: effect 'stribeck' of joint 1"
  "expected Fc <= Fs")

# What is wrong is reported together, also in rows of effects; XML is refused in one sentence.
file(WRITE ${WORK}/several.robot
  "number_link 1\nd L\ngy 9.81\neffect stribek joint=1\neffect stribeck joint=2\nstop\n")
refuse(1 "several mistakes" ARGUMENTS several.robot -o out/x.c SAYS "several.robot:2:3: error: unknown symbol 'L'"
  "several.robot:4:8: error: unknown effect 'stribek'" "several.robot:5:23: error: '2' is no joint")
refuse(1 URDF ARGUMENTS ${cases}/urdf/rr.urdf --count SAYS "rr.urdf:2:1: error: the robot is one link")

# Misspelt options are corrected, and no link leads to an input.
refuse(2 "a misspelt option" ARGUMENTS ${robot} --functons id -o out/x.c
  SAYS "unknown option '--functons'; did you mean '--functions'?")
refuse(2 "one dash" ARGUMENTS ${robot} -count SAYS "did you mean '--count'?")
file(COPY ${robot} DESTINATION ${WORK}/linked)
get_filename_component(name ${robot} NAME)
file(CREATE_LINK ${WORK}/linked/${name} ${WORK}/linked/code.c)
refuse(2 "a hard link to the robot file" ARGUMENTS linked/${name} -o linked/code.c SAYS "same file")
