// SPDX-License-Identifier: MIT
// What dynid says at once of a part that a call needs and that is absent.
#include "runtime/tools/dynid/options/parts.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/runtime/dynid/run_dynid.h"
#include "tests/support/temporary_path.h"

namespace dyngen::runtime {
namespace {

using test::dynid;
using test::Outcome;

const PartWords& words(Part part) {
  for (const PartWords& own : all_parts()) {
    if (own.part == part) return own;
  }
  throw std::logic_error("a part without words");
}

/// What a call asks for. @param call  words with blanks between
ToolOptions parsed(const std::string& call) {
  std::istringstream stream("dynid " + call);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  std::vector<const char*> argv;
  for (const std::string& word : words) argv.push_back(word.c_str());
  const ParsedOptions options = parse_options(static_cast<int>(argv.size()), argv.data());
  EXPECT_EQ(options.exit_code, -1) << call;
  return options.options;
}

struct Case {
  const char* call;
  Part part;
  const char* asker;
};

const std::vector<Case> kCases = {
    {"fit a.robot r.csv --consistent", Part::kCeres, "--consistent"},
    {"fit a.robot r.csv --json f.json", Part::kJson, "--json"},
    {"fit a.robot r.csv --report f.html", Part::kJson, "--report"},
    {"fit a.robot r.csv --figures f", Part::kGnuplot, "--figures"},
    {"fit a.robot r.csv.gz", Part::kZlib, "r.csv.gz"},
    {"fit a.robot r.csv --holdout h.csv.gz", Part::kZlib, "h.csv.gz"},
    {"fit a.robot r.csv --method iv --tracked t.csv.gz", Part::kZlib, "t.csv.gz"},
    {"check a.robot r.csv --json c.json", Part::kJson, "--json"},
    {"check a.robot r.csv.gz", Part::kZlib, "r.csv.gz"},
    {"accumulate a.robot r.csv.gz -o a.qr", Part::kZlib, "r.csv.gz"},
    {"simulate a.robot --trajectory t.csv -o r.csv", Part::kBoost, "simulate"},
    {"simulate a.robot --trajectory t.csv -o r.csv --picture p.svg", Part::kGnuplot, "--picture"},
    {"simulate a.robot --trajectory t.csv.gz -o r.csv", Part::kZlib, "t.csv.gz"},
    {"simulate a.robot --trajectory t.csv -o r.csv.gz", Part::kZlib, "r.csv.gz"},
    {"simulate a.robot --trajectory t.csv -o r.csv --truth s.csv.gz", Part::kZlib, "s.csv.gz"},
    {"excite a.robot -o t.csv", Part::kNlopt, "excite"},
    {"excite a.robot -o t.csv --for f.json", Part::kJson, "--for"},
    {"excite a.robot -o t.csv --json f.json", Part::kJson, "--json"},
    {"excite a.robot -o t.csv --report f.html", Part::kJson, "--report"},
    {"excite a.robot -o t.csv --figures f", Part::kGnuplot, "--figures"},
    {"excite a.robot -o t.csv --picture p.png", Part::kGnuplot, "--picture"},
    {"excite a.robot -o t.csv.gz", Part::kZlib, "t.csv.gz"},
    {"atlas a.robot r.csv --json f.json", Part::kJson, "--json"},
    {"atlas a.robot r.csv --report f.html", Part::kJson, "--report"},
    {"atlas a.robot r.csv --figures f", Part::kGnuplot, "--figures"},
    {"atlas a.robot r.csv --picture p.svg", Part::kGnuplot, "--picture"},
    {"atlas a.robot --trajectory t.csv.gz", Part::kZlib, "t.csv.gz"},
    {"effects --figures f", Part::kGnuplot, "--figures"},
    {"diagnose a.robot r.csv --json f.json", Part::kJson, "--json"},
    {"diagnose a.robot r.csv --report f.html", Part::kJson, "--report"},
    {"diagnose a.robot r.csv --figures f", Part::kGnuplot, "--figures"},
    {"diagnose a.robot r.csv --controller pd", Part::kBoost, "--controller"},
    {"diagnose a.robot r.csv --controller pd --commanded c.csv.gz", Part::kZlib, "c.csv.gz"},
    {"diagnose a.robot r.csv --reference old.csv.gz", Part::kZlib, "old.csv.gz"}};

TEST(MissingParts, AreNamedWithWhatAsksForThemAndTheirPackage) {
  for (const Case& own : kCases) {
    const std::string text =
        missing_parts(parsed(own.call), 1, [&](Part part) { return part != own.part; });
    EXPECT_EQ(text.rfind(std::string("dynid: ") + own.asker + ": ", 0), 0U) << own.call << text;
    EXPECT_NE(text.find(std::string("install ") + words(own.part).package), std::string::npos)
        << own.call << text;
  }
}

TEST(MissingParts, AreAskedForByNothingElse) {
  for (const Case& own : kCases) {
    const auto everything = [](Part) { return true; };
    EXPECT_EQ(missing_parts(parsed(own.call), 1, everything), "") << own.call;
  }
  const auto nothing = [](Part) { return false; };
  for (const char* call :
       {"fit a.robot r.csv --holdout h.csv -o b.robot", "check a.robot r.csv",
        "accumulate a.robot r.csv -o a.qr", "merge a.qr b.qr -o c.qr", "atlas a.robot r.csv",
        "effects", "effects stribeck", "effects --markdown e.md",
        "diagnose a.robot r.csv --holdout h.csv -o b.robot"}) {
    EXPECT_EQ(missing_parts(parsed(call), 1, nothing), "") << call;
  }
}

TEST(MissingParts, AreSaidTogether) {
  const ToolOptions options =
      parsed("fit a.robot r.csv --json f.json --report f.html --consistent");
  EXPECT_EQ(missing_parts(options, 1, [](Part) { return false; }),
            "dynid: --consistent: this dynid was built without Ceres; install libceres-dev and "
            "build it again\n"
            "dynid: --json, --report: this dynid was built without nlohmann-json; install "
            "nlohmann-json3-dev and build it again\n");
}

TEST(MissingParts, OfManyFilesNameAFew) {
  EXPECT_EQ(missing_parts(parsed("fit a.robot 1.gz 2.gz 3.gz 4.gz 5.gz 6.gz"), 1,
                          [](Part part) { return part != Part::kZlib; }),
            "dynid: 1.gz, 2.gz, 3.gz, 4.gz and 2 more: this dynid was built without zlib; install "
            "zlib1g-dev and build it again\n");
}

TEST(MissingParts, OfSeveralProcessesIsMpi) {
  const ToolOptions options = parsed("fit a.robot r.csv");
  const auto without = [](Part part) { return part != Part::kMpi; };
  EXPECT_EQ(missing_parts(options, 1, without), "");
  EXPECT_EQ(missing_parts(options, 3, without),
            "dynid: 3 processes of mpirun: this dynid was built without OpenMPI; install "
            "libopenmpi-dev and build it again\n");
}

TEST(MissingParts, ProcessesThatCannotTalkDoNothing) {
  if (has_part(Part::kMpi)) GTEST_SKIP() << "this dynid was built with MPI";
  for (const std::string rank : {"0", "1"}) {
    const Outcome run =
        dynid("fit absent.robot absent.csv", "OMPI_COMM_WORLD_SIZE=2 OMPI_COMM_WORLD_RANK=" + rank);
    EXPECT_EQ(run.exit_code, 2) << run.out;
    EXPECT_EQ(run.out.find("libopenmpi-dev") != std::string::npos, rank == "0") << run.out;
  }
}

TEST(MissingParts, WithoutGnuplotNothingIsReadOrWritten) {
  const std::string folder = test::temporary_path("figures_of_nothing");
  std::filesystem::remove_all(folder);
  // files that are absent would be an error of their own
  for (const std::string& call :
       {"fit absent.robot absent.csv --figures " + folder,
        "atlas absent.robot absent.csv --figures " + folder,
        "atlas absent.robot absent.csv --picture " + folder + ".svg",
        "diagnose absent.robot absent.csv --figures " + folder, "effects --figures " + folder}) {
    const Outcome run = dynid(call, "PATH=");
    EXPECT_EQ(run.exit_code, 2) << call << "\n" << run.out;
    EXPECT_NE(run.out.find("gnuplot is not installed; install gnuplot-nox\n"), std::string::npos)
        << call << "\n"
        << run.out;
    EXPECT_FALSE(std::filesystem::exists(folder)) << call;
  }
}

TEST(Parts, AreListedByVersionWithTheirPackages) {
  const Outcome run = dynid("--version");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.out.rfind("dynid 0.", 0), 0U) << run.out;
  for (const PartWords& own : all_parts()) {
    EXPECT_NE(run.out.find(own.package), std::string::npos) << run.out;
  }
  EXPECT_EQ(parts_text([](Part part) { return part == Part::kBoost; }).substr(0, 14),
            "with    Boost ");
  EXPECT_NE(parts_text([](Part) { return false; }).find("without NLopt "), std::string::npos);
}

}  // namespace
}  // namespace dyngen::runtime
