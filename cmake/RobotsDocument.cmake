# Writes robots.md and a drawing of each robot, OUTPUT/robots.md and OUTPUT/robots/NAME.svg, from robots/*.robot:
# what heads each file, and what dyngen reads of it.
#   cmake -DDYNGEN=dyngen -DSOURCE_DIR=the project -DOUTPUT=docs/reference -P cmake/RobotsDocument.cmake
foreach(name IN ITEMS DYNGEN SOURCE_DIR OUTPUT)
  if(NOT DEFINED ${name})
    message(FATAL_ERROR "RobotsDocument.cmake needs -D${name}=...")
  endif()
endforeach()
file(MAKE_DIRECTORY ${OUTPUT}/robots)

# dyngen_run(<variable> <arguments>...): what dyngen prints.
function(dyngen_run variable)
  execute_process(COMMAND ${DYNGEN} ${ARGN} WORKING_DIRECTORY ${SOURCE_DIR}
    RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE errors)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "dyngen ${ARGN}:\n${errors}")
  endif()
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

# The comment that heads a robot file as Markdown: "# Word   text" begins an entry.
function(heading_text variable file)
  file(READ ${file} text)
  string(REGEX MATCH "^(#[^\n]*\n)+" text "${text}")
  string(REGEX REPLACE "^# SPDX[^\n]*\n" "" text "${text}")
  string(REGEX REPLACE "(^|\n)# ([A-Z][A-Za-z]*)  +" "\\1- **\\2**: " text "${text}")
  string(REGEX REPLACE "(^|\n)#  +" "\\1  " text "${text}")
  string(REGEX REPLACE "(^|\n)# ?" "\\1" text "${text}")
  string(STRIP "${text}" text)
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

set(page "# The robots

The files of `robots/` as dyngen reads them: a drawing, and where every axis stands. This page and its drawings are written by
`cmake --build build --target robots_document`; a test compares them with the present output of dyngen. For your own arm:

```sh
dyngen arm.robot --explain --drawing arm.svg
```

**How to read a drawing.** A cylinder is a revolute joint about its z axis. A box is a prismatic joint along its z axis. A flat
grey plate is a fixed joint. They stand somewhere on their axis, not always at the origin of the frame. Axes of frames are red
(x), green (y) and blue (z), with the number of the link. Axes with the same origin and direction are one arrow. Joint j turns or
slides about z of frame j. Links are light and dark grey in turn. A dashed end continues beyond the last length of the file. The
cross in a ring is the end of the last link. Weight pulls downwards on the paper. The picture states the configuration. All joints
are at 0, except where limits exclude 0, a prismatic joint would have no length, or links would overlap.
")

file(GLOB robots ${SOURCE_DIR}/robots/*.robot)
list(SORT robots)
foreach(robot IN LISTS robots)
  cmake_path(GET robot STEM name)
  dyngen_run(words robots/${name}.robot --explain --drawing ${OUTPUT}/robots/${name}.svg)
  string(REGEX REPLACE "\n\nStandard parameters.*" "" words "${words}")
  string(REGEX MATCH "Base parameters: [0-9]+" base "${words}")
  string(REGEX REPLACE "\n\nBase parameters.*" "" words "${words}")
  heading_text(heading ${robot})
  string(APPEND page "
## ${name}

![${name}: its frames and joints](robots/${name}.svg)

${heading}

```text
${words}
```

${base} ([file](../../robots/${name}.robot))
")
endforeach()
file(WRITE ${OUTPUT}/robots.md "${page}")
