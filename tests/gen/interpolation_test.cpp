// SPDX-License-Identifier: MIT
#include "gen/base_parameters/interpolation.h"

#include <gtest/gtest.h>

#include "gen/base_parameters/echelon.h"
#include "gen/symbols/exact.h"

namespace dyngen::test {
namespace {

class InterpolationOf : public testing::Test {
 protected:
  /// What interpolate() makes of samples of these expressions.
  std::optional<std::vector<GiNaC::ex>> found(const std::vector<GiNaC::ex>& expressions) {
    const Sampler sampler =
        [&](const GiNaC::exmap& values) -> std::optional<std::vector<cln::cl_R>> {
      std::vector<cln::cl_R> numbers;
      for (const GiNaC::ex& expression : expressions) {
        const GiNaC::ex number = expression.subs(values).evalf();
        numbers.push_back(cln::the<cln::cl_R>(GiNaC::ex_to<GiNaC::numeric>(number).to_cl_N()));
      }
      return numbers;
    };
    const PrecisionScope precision;
    RandomStream random(5);
    return interpolate(sampler, {a, b, c}, random);
  }

  GiNaC::symbol a{"a"}, b{"b"}, c{"c"};
};

TEST_F(InterpolationOf, PolynomialsIsExact) {
  const std::vector<GiNaC::ex> wanted = {GiNaC::ex(0), GiNaC::ex(-2), 2 * a,
                                         GiNaC::pow(a, 2) - GiNaC::numeric(3, 7) * b * c + 1,
                                         GiNaC::pow(c, 4)};
  const auto result = found(wanted);
  ASSERT_TRUE(result.has_value());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_TRUE(((*result)[i] - wanted[i]).expand().is_zero()) << wanted[i] << ", " << (*result)[i];
  }
}

TEST_F(InterpolationOf, IrrationalCoefficientsKeepsTheirDigits) {
  const auto result = found({GiNaC::sqrt(GiNaC::ex(3)) * a});
  ASSERT_TRUE(result.has_value());
  const PrecisionScope precision;
  const GiNaC::ex error = ((*result)[0] / a - GiNaC::sqrt(GiNaC::ex(3))).evalf();
  EXPECT_LT(GiNaC::abs(GiNaC::ex_to<GiNaC::numeric>(error)), GiNaC::numeric("1e-42"));
}

TEST_F(InterpolationOf, OtherFunctionsFindsNothing) {
  EXPECT_FALSE(found({1 / (2 + a)}).has_value());
  EXPECT_FALSE(found({GiNaC::pow(a, 5)}).has_value());
  EXPECT_FALSE(found({a, GiNaC::sin(b)}).has_value());
}

TEST(EchelonForm, HasItsPivotsLeftmost) {
  const PrecisionScope precision;
  const Echelon form = echelon({{0, 2, 4, 2}, {0, 1, 2, 5}, {0, 3, 6, 7}}, 4);
  EXPECT_EQ(form.pivots, (std::vector<std::size_t>{1, 3}));
  ASSERT_EQ(form.rank(), 2u);
  EXPECT_EQ(form.rows[0][2], 2);
  EXPECT_EQ(form.rows[0][3], 0);
}

}  // namespace
}  // namespace dyngen::test
