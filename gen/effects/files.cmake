# The effects that are part of the program.
set(effect_files
  stribeck.effect)
