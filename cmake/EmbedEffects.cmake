# Writes OUTPUT, a C++ file with the texts of FILES in it.
# Called by the build: cmake -DOUTPUT=... -DFILES=a.effect;b.effect -P EmbedEffects.cmake
set(entries "")
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME)
  file(READ "${file}" text)
  string(APPEND entries "      {\"${name}\", R\"effect(${text})effect\"},\n")
endforeach()
set(content "// SPDX-License-Identifier: GPL-2.0-or-later
// Made from gen/effects/*.effect by the build.
#include \"gen/effects/effect_texts.h\"

namespace dyngen {

const std::vector<EffectSource>& effect_texts() {
  static const std::vector<EffectSource> kTexts = {
${entries}  };
  return kTexts;
}

}  // namespace dyngen
")
file(WRITE "${OUTPUT}.new" "${content}")
file(RENAME "${OUTPUT}.new" "${OUTPUT}")
