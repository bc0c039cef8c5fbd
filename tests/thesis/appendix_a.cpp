// SPDX-License-Identifier: MIT
#include "tests/thesis/appendix_a.h"

namespace dyngen::test {

const std::vector<PrintedColumn>& appendix_a() {
  static const std::vector<PrintedColumn> kColumns = {
      {"ZZ1", {"a1", "0", "0"}, {}},
      {"ZZ2", {"0", "a2", "0"}, {}},
      {"MX2", {"0", "C2*g", "0"}, {}},
      {"MY2", {"0", "-S2*g", "0"}, {}},
      {"XX2", {"a1 - C2^2*a1 + 2*S2*C2*w1*w2", "-C2*w1^2*S2", "0"}, {}},
      {"XZ2", {"C2*w2^2 + S2*a2", "S2*a1", "0"}, {}},
      {"XY2", {"2*S2*C2*a1 + 4*C2^2*w1*w2 - 2*w1*w2", "w1^2 - 2*C2^2*w1^2", "0"}, {}},
      {"YZ2", {"C2*a2 - S2*w2^2", "C2*a1", "0"}, {}},
      {"ZZ3", {"0", "a3 + a2", "a3 + a2"}, {}},
      {"MX3",
       {"-4*C2*C3*S2*w1*w2*L - 2*C2*L*w3*C3*S2*w1 + 2*S3*w1*w2*L - 4*L*S3*C2^2*w1*w2"
        " + 2*C3*L*C2^2*a1 - 2*S2*S3*L*C2*a1 - 2*L*w3*S3*C2^2*w1",
        "2*C3*a2*L + C3*C2*g + 2*C3*S2*w1^2*C2*L + 2*S3*C2^2*w1^2*L - S3*S2*g - L*S3*w3^2"
        " + L*C3*a3 - 2*L*S3*w2*w3 - L*w1^2*S3",
        "-S3*S2*g + C3*C2*g + S3*C2^2*w1^2*L + S3*w2^2*L + C3*a2*L + C3*S2*w1^2*C2*L"},
       {}},
      // the last angle of c2 has lost its dot: theta_3 in place of its rate
      {"MY3",
       {"-2*S3*L*C2^2*a1 + 2*C3*w1*w2*L - 4*L*C3*C2^2*w1*w2 + 4*C2*S3*S2*w1*w2*L"
        " + 2*C2*L*w3*S3*S2*w1 - 2*S2*C3*L*C2*a1 - 2*L*w3*C3*C2^2*w1",
        "-S3*C2*g - 2*S3*a2*L - 2*S3*S2*w1^2*C2*L - C3*S2*g + 2*C3*C2^2*w1^2*L - L*S3*a3"
        " - L*C3*w3^2 - L*w1^2*C3 - 2*L*C3*w2*q3",
        "-C3*S2*g - S3*C2*g + C3*C2^2*w1^2*L + C3*w2^2*L - S3*a2*L - S3*S2*w1^2*C2*L"},
       {"",
        "-S3*C2*g - 2*S3*a2*L - 2*S3*S2*w1^2*C2*L - C3*S2*g + 2*C3*C2^2*w1^2*L - L*S3*a3"
        " - L*C3*w3^2 - L*w1^2*C3 - 2*L*C3*w2*w3",
        ""}},
      // c1 is damaged after its fourth term; of c2 and c3 a tail is left
      {"XX3",
       {"?", "?", "?"},
       {"(S2*C3 + C2*S3)^2*a1 + 2*(S2*C3 + C2*S3)*(C2*C3 - S2*S3)*w1*(w2 + w3)",
        "-(S2*C3 + C2*S3)*(C2*C3 - S2*S3)*w1^2", "-(S2*C3 + C2*S3)*(C2*C3 - S2*S3)*w1^2"}},
      {"XZ3",
       {"C2*S3*a3 + C2*C3*w3^2 + C2*C3*w2^2 - S2*S3*w3^2 - S2*S3*w2^2 + S2*C3*a3 + S2*C3*a2"
        " + 2*C2*C3*w2*w3 + C2*S3*a2 - 2*S2*S3*w2*w3",
        "S3*C2*a1 + C3*S2*a1", "S3*C2*a1 + C3*S2*a1"},
       {}},
      // c1: accelerations that lost their dots, and a piece printed twice (only what is left of it
      // is kept here); c2: 2 in place of 4 in the mixed term; c3 is lost
      {"XY3",
       {"-4*w3*w1*C3^2 - 4*w3*C2^2*w1 - 2*S2*C2*a1 - 4*C2^2*w1*w2 - 2*C3*S3*q1"
        " - 8*S2*C3*S3*C2*w1*w2 - 8*S2*C3*w3*S3*C2*w1 + 4*S3*C3*C2^2*a1 + 8*w3*C3^2*C2^2*w1"
        " + 8*C3^2*C2^2*w1*w2 + 4*S2*C3^2*C2*q1 + 2*w1*w2 - 4*w1*w2*C3^2 + 2*w3*w1",
        "2*C3^2*w1^2 - 4*C3^2*C2^2*w1^2 + 2*C3*S2*w1^2*S3*C2 - w1^2 + 2*C2^2*w1^2", "?"},
       {"-4*w3*w1*C3^2 - 4*w3*C2^2*w1 - 2*S2*C2*a1 - 4*C2^2*w1*w2 - 2*C3*S3*a1"
        " - 8*S2*C3*S3*C2*w1*w2 - 8*S2*C3*w3*S3*C2*w1 + 4*S3*C3*C2^2*a1 + 8*w3*C3^2*C2^2*w1"
        " + 8*C3^2*C2^2*w1*w2 + 4*S2*C3^2*C2*a1 + 2*w1*w2 - 4*w1*w2*C3^2 + 2*w3*w1",
        "2*C3^2*w1^2 - 4*C3^2*C2^2*w1^2 + 4*C3*S2*w1^2*S3*C2 - w1^2 + 2*C2^2*w1^2",
        "-((C2*C3 - S2*S3)^2 - (S2*C3 + C2*S3)^2)*w1^2"}},
      // c1: an acceleration that lost a dot, and the term C2 C3 a2 is missing
      {"YZ3",
       {"-S2*C3*w3^2 - S2*S3*a2 - 2*S2*C3*w2*w3 - C2*S3*w3^2 - 2*C2*S3*w2*w3 - C2*S3*w2^2"
        " - S2*S3*w3 + C2*C3*a3 - S2*C3*w2^2",
        "-S3*S2*a1 + C3*C2*a1", "-S3*S2*a1 + C3*C2*a1"},
       {"-S2*C3*w3^2 - S2*S3*a2 - 2*S2*C3*w2*w3 - C2*S3*w3^2 - 2*C2*S3*w2*w3 - C2*S3*w2^2"
        " - S2*S3*a3 + C2*C3*a3 - S2*C3*w2^2 + C2*C3*a2",
        "", ""}},
  };
  return kColumns;
}

}  // namespace dyngen::test
