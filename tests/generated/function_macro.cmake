# The macro before every function: the text is C99 as it is, header-only C++ with `static inline`, and code of a
# graphics processor with `__host__ __device__`.
include(${CMAKE_CURRENT_LIST_DIR}/../script.cmake)
string(REPLACE "," ";" COMPILERS "${COMPILERS}")
string(REPLACE "," ";" WARNINGS "${WARNINGS}")

run(text 0 ${DYNGEN} ${SOURCE_DIR}/robots/puma560.robot -o ${WORK}/puma560.c --search 0 --functions all
  --parameters runtime)
run(text 0 ${DYNGEN} ${SOURCE_DIR}/tests/robots/effects/stateful_arm.robot -o ${WORK}/arm.c --search 0
  --prefix arm)

# Two sources include the functions and the tables; the linker sees one of each table.
file(WRITE ${WORK}/puma560_inline.hpp [[
#pragma once
#define PUMA560_FUNCTION static inline
#define ARM_FUNCTION static inline
#include "puma560.c"
#include "arm.c"
]])
file(WRITE ${WORK}/one.cpp [[
#include "puma560_inline.hpp"
const char *other_name(int joint);
double other_gravity(const double *q);
int main() {
  const double q[PUMA560_NQ] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  double tau[PUMA560_NQ];
  puma560_gravity(q, puma560_chi_values, tau);
  if (puma560_joint_names[2] != other_name(2)) return 1; /* one table */
  arm_state state;
  arm_reset(&state, 0.001);
  if (arm_state_names[0] == nullptr) return 2;
  return tau[1] == other_gravity(q) && tau[1] != 0 ? 0 : 3;
}
]])
file(WRITE ${WORK}/two.cpp [[
#include "puma560_inline.hpp"
const char *other_name(int joint) { return puma560_joint_names[joint]; }
double other_gravity(const double *q) {
  double tau[PUMA560_NQ];
  puma560_gravity(q, puma560_chi_values, tau);
  return tau[1];
}
]])
foreach(compiler IN LISTS COMPILERS)
  run(text 0 ${compiler} -std=c99 ${WARNINGS} -Werror -c puma560.c -o c99.o)
  run(text 0 ${compiler} -xc++ -std=c++17 ${WARNINGS} -Werror -O1 one.cpp two.cpp -o main -lm -lstdc++)
  run(text 0 ${WORK}/main)
endforeach()
# The same in C.
file(WRITE ${WORK}/first.c [[
#define PUMA560_FUNCTION static inline
#include "puma560.c"
const char *other_name(void);
int main(void) { return puma560_joint_names[1] == other_name() ? 0 : 1; }
]])
file(WRITE ${WORK}/second.c [[
#define PUMA560_FUNCTION static inline
#include "puma560.c"
const char *other_name(void);
const char *other_name(void) { return puma560_joint_names[1]; }
]])
foreach(compiler IN LISTS COMPILERS)
  run(text 0 ${compiler} -std=c99 ${WARNINGS} -Werror -O1 first.c second.c -o main_c -lm)
  run(text 0 ${WORK}/main_c)
endforeach()

# CUDA: a kernel calls the functions, for one sample and as batches.
file(WRITE ${WORK}/kernel.cu [[
#include "puma560.c"
#include "arm.c"
__global__ void kernel(const double *q, const double *chi, double *tau) {
  arm_state state;
  arm_reset(&state, 0.001);
  arm_id(&state, q, q, q, tau);
  puma560_id(q, q, q, chi, tau);
  puma560_mass_matrix(q, chi, tau);
  puma560_gravity_batch(4, q, chi, tau);
}
]])
find_program(nvcc NAMES nvcc PATHS /usr/local/cuda/bin)
if(nvcc)
  run(text 0 ${nvcc} -std=c++17 "-DPUMA560_FUNCTION=__host__ __device__" "-DARM_FUNCTION=__host__ __device__"
    -Werror all-warnings -c kernel.cu -o kernel.o)
else()
  message(STATUS "skipped: there is no nvcc")
endif()
foreach(compiler IN LISTS COMPILERS)
  get_filename_component(name ${compiler} NAME)
  if(NOT name MATCHES "clang")
    continue()
  endif()
  # without CUDA's headers: what they define is written here
  file(WRITE ${WORK}/standing_in.h [[
#define __host__ __attribute__((host))
#define __device__ __attribute__((device))
#define __global__ __attribute__((global))
__device__ double sin(double);
__device__ double cos(double);
__device__ double fabs(double);
__device__ double exp(double);
__device__ double expm1(double);
__device__ double tanh(double);
__device__ double sqrt(double);
__device__ double log(double);
__device__ double pow(double, double);
__device__ void *memcpy(void *, const void *, __SIZE_TYPE__);
]])
  foreach(side IN ITEMS --cuda-host-only --cuda-device-only)
    run(text 0 ${compiler} -xcuda ${side} --cuda-gpu-arch=sm_60 -nocudalib -nocudainc -fsyntax-only
      -Wno-unknown-cuda-version -std=c++17 -include standing_in.h "-DPUMA560_FUNCTION=__host__ __device__"
      "-DARM_FUNCTION=__host__ __device__" kernel.cu)
  endforeach()
endforeach()
