# The headers of dyngen that a program may include, as `cmake --install` puts them below include/dyngen/runtime. Each has
# an example in tests/package/examples. `_public`: to be included. `_detail`: included by those, and free to change.

set(dyngen_runtime_public
  control/control_model.h
  control/controller.h
  control/gains.h
  control/velocity_filter.h
  estimation/matrix_products.h
  identification/fit.h
  identification/motion_rows.h
  identification/motion_source.h
  identification/summary.h
  model/linear_model.h
  model/model_functions.h
  recordings/clipping.h
  recordings/notice.h
  recordings/periods.h
  recordings/quantisation.h
  recordings/reader.h
  recordings/recording.h
  recordings/time_base.h
  recordings/trajectory_file.h
  recordings/writer.h
  recursive/convergent_mode_lms.h
  recursive/gain.h
  recursive/lms.h
  recursive/minimum_variance.h
  recursive/rls.h
  signals/joint_state.h
  signals/motion.h
  simulation/closed_loop.h
  simulation/plant.h
  simulation/plant_model.h)
set(dyngen_runtime_detail
  control/friction_compensation.h
  effects/effect_law.h
  estimation/instruments.h
  estimation/least_squares.h
  estimation/noise_model.h
  estimation/ridge.h
  estimation/rows.h
  estimation/torque_factor.h
  estimation/unseen.h
  recordings/notice_log.h
  recordings/row_queue.h
  recordings/sample_rows.h
  recursive/sample.h
  recursive/ud_covariance.h
  signals/butterworth.h
  signals/cutoff.h
  signals/decimation.h
  simulation/plant_effects.h
  simulation/torque_noise.h)

# With the component `consistency`, and with `excitation`.
set(dyngen_consistency_public consistency/consistent_parameters.h)
set(dyngen_consistency_detail)
set(dyngen_excitation_public
  excitation/excitation.h
  excitation/motion_limits.h
  excitation/multistage.h)
set(dyngen_excitation_detail
  excitation/criterion.h
  excitation/held_accelerations.h
  excitation/information.h
  excitation/limited_trajectory.h
  excitation/trajectory_basis.h)
