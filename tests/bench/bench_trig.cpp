// SPDX-License-Identifier: MIT
// Accuracy of the sines and cosines that stand in emitted code: every one judged by CLN.
//
//   bench_trig [--points N] [--flags "flags of the compiler"]
//
// N angles of each of four kinds, 2.5e6 unless said otherwise: ten million in all, some minutes.
// Exit code 1 if an error passes 1 unit in the last place.
#include <cln/real.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <exception>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>

#include "tests/support/inline_trig_library.h"

namespace dyngen::bench {
namespace {

constexpr double kLimit = 1.0;
constexpr std::uint64_t kSeed = 20260101;

struct Worst {
  double error = 0;  // units in the last place
  double angle = 0;
};

/// |value - exact| over the spacing of doubles at |exact|.
double error_of(double value, const cln::cl_R& exact) {
  if (cln::zerop(exact)) return value == 0 ? 0 : std::numeric_limits<double>::infinity();
  const double size = std::fabs(cln::double_approx(exact));
  const double ulp = std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
  const cln::cl_R difference = cln::rational(cln::cl_DF(value)) - cln::rational(exact);
  return std::fabs(cln::double_approx(difference / cln::rational(cln::cl_DF(ulp))));
}

void judge(double angle, double sine, double cosine, Worst& worst) {
  static const cln::float_format_t digits = cln::float_format(50);
  const cln::cos_sin_t exact =
      cln::cos_sin(cln::cl_float(cln::rational(cln::cl_DF(angle)), digits));
  const double error = std::max(error_of(sine, exact.sin), error_of(cosine, exact.cos));
  if (error > worst.error) worst = {error, angle};
}

struct Kind {
  const char* name;
  std::function<double(std::mt19937_64&)> draw;
};

double uniform(std::mt19937_64& random, double limit) {
  return std::uniform_real_distribution<double>(-limit, limit)(random);
}

std::array<Kind, 4> kinds() {
  return {{{"uniform, |x| < 1e5", [](auto& random) { return uniform(random, 1e5); }},
           {"next to multiples of pi/2",
            [](auto& random) {
              const double at = std::round(uniform(random, 63661)) * 1.5707963267948966;
              return at + std::ldexp(at, -52) * std::round(uniform(random, 3));
            }},
           {"uniform, |x| < 4", [](auto& random) { return uniform(random, 4); }},
           {"log-uniform, 1e-12 < |x| < 1e5", [](auto& random) {
              const double size =
                  std::exp(std::log(1e-12) + std::fabs(uniform(random, 1)) * std::log(1e17));
              return (random() & 1) != 0 ? size : -size;
            }}}};
}

int run(long points, const std::string& flags) {
  const test::InlineTrigLibrary library(flags);
  std::mt19937_64 random(kSeed);
  double largest = 0;
  fmt::print("{} angles of each kind, judged by CLN at 50 digits; compiled with {}\n", points,
             flags);
  for (const Kind& kind : kinds()) {
    Worst worst;
    for (long i = 0; i < points; ++i) {
      // one angle a call: the range is tested over all angles of a call
      const double x = kind.draw(random);
      double s = 0, c = 0;
      library({&x, 1}, {&s, 1}, {&c, 1});
      judge(x, s, c, worst);
    }
    fmt::print("{:<32} {:.4f} ulp at {:.17g}\n", kind.name, worst.error, worst.angle);
    largest = std::max(largest, worst.error);
  }
  fmt::print("largest error: {:.4f} ulp, limit {}\n", largest, kLimit);
  return largest > kLimit ? 1 : 0;
}

}  // namespace
}  // namespace dyngen::bench

int main(int argc, char** argv) {
  long points = 2'500'000;
  std::string flags = "-std=c99 -O2";
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string_view option = argv[i], value = argv[i + 1];
    if (option == "--flags") flags = value;
    if (option == "--points") std::from_chars(value.data(), value.data() + value.size(), points);
  }
  if (argc % 2 == 0 || points < 1) {
    fmt::print(stderr, "usage: bench_trig [--points N] [--flags FLAGS]\n");
    return 2;
  }
  try {
    return dyngen::bench::run(points, flags);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_trig: {}\n", error.what());
    return 1;
  }
}
