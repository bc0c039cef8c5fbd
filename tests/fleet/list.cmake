# `dynid fit --list` in one process: by file, what is lost is left out by name.
include(${CMAKE_CURRENT_LIST_DIR}/../script.cmake)
set(robot ${SOURCE_DIR}/robots/puma560_3dof.robot)
run(text 0 ${MAKE_FLEET} ${robot} part 4 10 500)
set(all part/0.csv part/1.csv part/2.csv part/3.csv)

# The same as one .qr file of all of them.
run(text 0 ${DYNID} fit ${robot} --list part/list.txt -o list.robot --json list.json)
expect_text(--list "${text}" "4 recordings, ")
expect_no_text(--list "${text}" "left out: ")
run(text 0 ${DYNID} accumulate ${robot} ${all} -o all.qr)
run(text 0 ${DYNID} fit ${robot} all.qr -o qr.robot --json qr.json)
expect_same_file("--list and .qr" ${WORK}/list.robot ${WORK}/qr.robot)
expect_same_file("--list and .qr" ${WORK}/list.json ${WORK}/qr.json)

# A list may be of .qr files, and of both.
foreach(i RANGE 3)
  run(text 0 ${DYNID} accumulate ${robot} part/${i}.csv -o ${i}.qr)
endforeach()
file(WRITE ${WORK}/mixed.txt "# of two kinds\n0.qr\npart/1.csv\r\n\n2.qr\npart/3.csv\n")
run(text 0 ${DYNID} fit ${robot} --list mixed.txt -o mixed.robot)
expect_same_file("recordings and .qr files" ${WORK}/list.robot ${WORK}/mixed.robot)

# Lost and damaged files.
file(WRITE ${WORK}/damaged.csv "time,q1,q2,q3\n0,1,2,3\n")
file(WRITE ${WORK}/damaged.qr "dyngenqr and then nothing")
file(WRITE ${WORK}/bad.txt
  "part/0.csv\ndamaged.csv\npart/1.csv\nlost.csv\npart/2.csv\ndamaged.qr\npart/3.csv\n")
run(text 0 ${DYNID} fit ${robot} --list bad.txt -o bad.robot --json bad.json)
expect_text("a bad list" "${text}" "damaged.csv:1" "lost.csv" "damaged.qr: error: version"
  "left out: damaged.csv, lost.csv, damaged.qr")
expect_same_file("without what is damaged" ${WORK}/list.robot ${WORK}/bad.robot)
file(READ ${WORK}/bad.json json)
expect_text(bad.json "${json}" "left out: damaged.csv, lost.csv, damaged.qr")

file(WRITE ${WORK}/nothing.txt "lost.csv\ndamaged.csv\n")
run(text 1 ${DYNID} fit ${robot} --list nothing.txt -o nothing.robot)
expect_text("all lost" "${text}" "lost.csv" "damaged.csv" "none of the files can be used")
if(EXISTS ${WORK}/nothing.robot)
  message(FATAL_ERROR "nothing.robot was written")
endif()
run(text 1 ${DYNID} fit ${robot} --list absent.txt)
expect_text("no list" "${text}" "cannot read absent.txt: No such file")
file(WRITE ${WORK}/empty.txt "# nothing\n")
run(text 1 ${DYNID} fit ${robot} --list empty.txt)
expect_text("an empty list" "${text}" "no recording in empty.txt")
run(text 1 ${DYNID} fit ${robot} --list part/list.txt --method irls)
expect_text("irls" "${text}" "method irls looks at single samples")
run(text 1 ${DYNID} fit ${robot} --list part/list.txt --holdout-part 0.4)
expect_text("--holdout-part" "${text}" "hold whole recordings out by --holdout")
run(text 0 ${DYNID} fit ${robot} --list part/list.txt --holdout part/1.csv)
expect_text("--holdout" "${text}" "part/1.csv (held out)")
