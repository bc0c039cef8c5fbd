// SPDX-License-Identifier: MIT
// Diagnoses simulated recordings whose truth is known, and prints as markdown how well:
// docs/explanation/studies.md.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <charconv>
#include <cstdio>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/studies/diagnosis_table.h"

namespace {

using namespace dyngen::test;

constexpr const char* kUsage =
    "usage: diagnosis_study [--cases N (20, of each kind)]\n"
    "    [--kind null|single|pair|theorem|unknown|time_local (all)]\n"
    "    [--lambda L (10 20 40 60 80 150 300 in turn)] [--robot puma3|ur10e|planar2 (puma3)]\n"
    "    [--noise white|mixed|slow|closed_loop (in turn)|rounded_loop|pink] [--only FAMILY] "
    "[--first-seed S (1)]\n"
    "    [--jobs J (2)] [--once] [--each] [--baselines]\n"
    "  --once  motions that do not repeat\n";

struct StudyPlan {
  int cases = 20;
  std::vector<CaseKind> kinds = {CaseKind::kNull,    CaseKind::kSingle,  CaseKind::kPair,
                                 CaseKind::kTheorem, CaseKind::kUnknown, CaseKind::kTimeLocal};
  std::vector<double> lambdas = {10, 20, 40, 60, 80, 150, 300};
  CaseRequest request;
  int jobs = 2;
  bool each = false, baselines = false;
};

template <class T>
T number(const std::string& text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value > 0)) {
    throw std::invalid_argument(fmt::format("'{}': expected a positive number", text));
  }
  return value;
}

StudyPlan plan_of(const std::vector<std::string>& words) {
  StudyPlan plan;
  plan.request.seed = 1;
  const std::map<std::string, std::function<void(const std::string&)>> options = {
      {"--cases", [&](const std::string& text) { plan.cases = number<int>(text); }},
      {"--kind", [&](const std::string& text) { plan.kinds = {case_kind(text)}; }},
      {"--lambda", [&](const std::string& text) { plan.lambdas = {number<double>(text)}; }},
      {"--robot", [&](const std::string& text) { plan.request.robot = text; }},
      {"--noise", [&](const std::string& text) { plan.request.noise = case_noise(text); }},
      {"--only", [&](const std::string& text) { plan.request.family = text; }},
      {"--first-seed",
       [&](const std::string& text) { plan.request.seed = number<unsigned>(text); }},
      {"--jobs", [&](const std::string& text) { plan.jobs = number<int>(text); }}};
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--once") {
      plan.request.once = true;
    } else if (words[i] == "--each") {
      plan.each = true;
    } else if (words[i] == "--baselines") {
      plan.baselines = true;
    } else if (const auto option = options.find(words[i]);
               option != options.end() && i + 1 < words.size()) {
      option->second(words[++i]);
    } else {
      throw std::invalid_argument(fmt::format("'{}' is not understood", words[i]));
    }
  }
  return plan;
}

std::vector<CaseRequest> requests_of(const StudyPlan& plan) {
  std::vector<CaseRequest> requests;
  for (const CaseKind kind : plan.kinds) {
    for (int i = 0; i < plan.cases; ++i) {
      CaseRequest request = plan.request;
      request.kind = kind;
      request.seed += static_cast<unsigned>(i);
      request.lambda = plan.lambdas[static_cast<std::size_t>(i) % plan.lambdas.size()];
      requests.push_back(request);
    }
  }
  return requests;
}

/// A process that takes every jobs-th case and writes a line of each into a pipe.
FILE* started(const std::vector<CaseRequest>& requests, const StudyPlan& plan, int job) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("pipe() failed");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork() failed");
  if (child > 0) {
    close(ends[1]);
    return fdopen(ends[0], "r");
  }
  close(ends[0]);
  FILE* out = fdopen(ends[1], "w");
  for (std::size_t i = static_cast<std::size_t>(job); i < requests.size();
       i += static_cast<std::size_t>(plan.jobs)) {
    std::fputs((to_line(run_case(requests[i], plan.baselines)) + "\n").c_str(), out);
    std::fflush(out);
  }
  std::fclose(out);
  _exit(0);
}

/// @throws std::runtime_error  if the process ended without it
CaseScore received(FILE* in) {
  std::string line;
  for (int c = std::fgetc(in); c != EOF && c != '\n'; c = std::fgetc(in)) {
    line.push_back(static_cast<char>(c));
  }
  if (line.empty()) throw std::runtime_error("a process ended before its work was done");
  return from_line(line);
}

int run(const StudyPlan& plan) {
  const std::vector<CaseRequest> requests = requests_of(plan);
  std::vector<FILE*> processes;
  for (int job = 0; job < plan.jobs; ++job) processes.push_back(started(requests, plan, job));
  std::vector<CaseScore> scores;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    scores.push_back(received(processes[i % processes.size()]));
    if (!plan.each) continue;
    fmt::print("{}\n", in_words(scores.back()));
    std::fflush(stdout);
  }
  for (FILE* process : processes) std::fclose(process);
  while (wait(nullptr) > 0) continue;
  fmt::print("{}{} cases of each kind, seeds from {}, robot {}\n\n{}", plan.each ? "\n" : "",
             plan.cases, plan.request.seed, plan.request.robot, tables(scores));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(plan_of({argv + 1, argv + argc}));
  } catch (const std::invalid_argument& error) {
    fmt::print(stderr, "diagnosis_study: {}\n{}", error.what(), kUsage);
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "diagnosis_study: {}\n", error.what());
    return 1;
  }
}
