# Two robots, and one robot under two prefixes, live in one program of C or C++.
include(${CMAKE_CURRENT_LIST_DIR}/../script.cmake)
string(REPLACE "," ";" COMPILERS "${COMPILERS}")
string(REPLACE "," ";" WARNINGS "${WARNINGS}")

run(text 0 ${DYNGEN} ${SOURCE_DIR}/robots/puma560.robot -o ${WORK}/puma560.c)
run(text 0 ${DYNGEN} ${SOURCE_DIR}/robots/planar2r.robot -o ${WORK}/planar2r.c)
run(text 0 ${DYNGEN} ${SOURCE_DIR}/robots/planar2r.robot -o ${WORK}/left.c
  --prefix left --scalar float --parameters runtime)
file(WRITE ${WORK}/main.c [[
#include "left.h"
#include "planar2r.h"
#include "puma560.h"

int main(void) {
  const double q[PUMA560_NQ] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  const float q_left[LEFT_NQ] = {0.1f, 0.2f};
  float chi[LEFT_NCHI];
  double tau[PUMA560_NQ], tau2[PLANAR2R_NQ];
  float tau_left[LEFT_NQ];
  int k;
  for (k = 0; k < LEFT_NCHI; ++k) chi[k] = (float)left_chi_values[k];
  puma560_gravity(q, tau);
  planar2r_gravity(q, tau2);
  left_gravity(q_left, chi, tau_left);
  for (k = 0; k < PLANAR2R_NQ; ++k) {
    const double difference = tau2[k] - (double)tau_left[k];
    if (difference > 1e-4 || difference < -1e-4) return 1;
  }
  return tau[1] < 0 ? 0 : 2; /* the shoulder holds the arm up */
}
]])
foreach(compiler IN LISTS COMPILERS)
  foreach(language IN ITEMS "-std=c99" "-xc++;-std=c++20")
    run(text 0 ${compiler} ${language} ${WARNINGS} -Werror
      main.c puma560.c planar2r.c left.c -o main -lm)
    run(text 0 ${WORK}/main)
  endforeach()
endforeach()
