// SPDX-License-Identifier: MIT
// dynid import and --map as their users call them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "runtime/recordings/reader.h"
#include "tests/runtime/dynid/run_dynid.h"

namespace dyngen::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using ImportJson = nlohmann::json;

const std::string kArm2 =
    "name arm2\nnumber_link 2\ndh modified\nsigma 0 0\nal pi/2 0\nd 0 0.5\nth 0 0\nr 0 0\n"
    "m * *\nmX * *\nmY * *\nmZ * *\nXX * *\nXY * *\nXZ * *\nYY * *\nYZ * *\nZZ * *\nIA * *\n"
    "Fs * *\nFv * *\noff 0 0\ngx 0\ngy 0\ngz 9.81\nstop\n";

/// What each of the cases must find.
const std::map<std::string, double> kTruth = {
    {"ZZR1", 1.2404}, {"MXR1", 1.8},  {"MY1", 0.04}, {"FV1", 1.5}, {"FS1", 3.0}, {"ZZ2", 0.0752},
    {"MX2", 0.3},     {"MY2", -0.02}, {"IA2", 0.2},  {"FV2", 0.8}, {"FS2", 1.5}};

class ImportCommand : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              (std::string("import_") + std::to_string(getpid()) + "_" +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
    write("arm2.robot", kArm2);
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string made(const std::string& name) const {
    return (folder_ / name).string();
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(made(name)) << text;
  }

  /// Base parameters within 5 % of the truth, or what else is wrong.
  void expect_truth(const std::string& arguments) const {
    const Outcome outcome =
        dynid("fit " + made("arm2.robot") + " " + arguments + " --json " + made("fit.json"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.out;
    const ImportJson fit = ImportJson::parse(content(made("fit.json")));
    std::map<std::string, ImportJson> found;
    for (const ImportJson& one : fit.at("parameters")) found[one.at("name")] = one;
    for (const auto& [name, value] : kTruth) {
      ASSERT_TRUE(found.contains(name)) << name;
      const double std =
          found[name].at("std").is_number() ? found[name].at("std").get<double>() : 0;
      EXPECT_NEAR(found[name].at("value").get<double>(), value,
                  std::max(0.05 * std::abs(value), 5 * std))
          << name << "\n"
          << outcome.out;
    }
  }

  /// A case by --map, and by import.
  void expect_case(const std::string& name) const {
    const std::string log = DYNGEN_SOURCE_DIR "/tests/data/cases/" + name + "/run.csv.gz";
    const std::string map = std::string(DYNGEN_MAPS) + "/" + name + ".yaml";
    expect_truth(log + " --map " + map);
    const Outcome outcome = dynid("import " + map + " " + log + " -o " + made("run.csv.gz") +
                                  " --robot " + made("arm2.robot"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.out;
    EXPECT_THAT(outcome.out, HasSubstr("samples of 2 joints"));
    expect_truth(made("run.csv.gz"));
  }

  /// The commands of a tutorial, in its order, in a folder with copies of the example's files.
  /// @return  how many there are
  int run_tutorial(const std::string& page, const std::string& example) const {
    for (const auto& entry : fs::directory_iterator(DYNGEN_SOURCE_DIR "/examples/" + example)) {
      fs::copy_file(entry.path(), made(entry.path().filename().string()));
    }
    std::istringstream lines(content(DYNGEN_SOURCE_DIR "/docs/howto/" + page));
    int commands = 0;
    bool shell = false;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("```")) shell = line == "```sh";
      const bool identifies = line.starts_with("dynid ");
      if (!shell || (!identifies && !line.starts_with("dyngen "))) continue;
      const std::string tool = identifies ? DYNID : DYNGEN;
      const std::string words = line.substr(line.find(' '));
      const Outcome outcome = run_shell("cd " + folder_.string() + " && " + tool + words);
      EXPECT_EQ(outcome.exit_code, 0) << line << "\n" << outcome.out;
      ++commands;
    }
    return commands;
  }

  fs::path folder_;
};

TEST_F(ImportCommand, ReadsATopicWrittenAsCsv) { expect_case("ros_csv"); }
TEST_F(ImportCommand, ReadsAControllersTrace) { expect_case("controller_trace"); }
TEST_F(ImportCommand, ReadsAFileWithoutHeader) { expect_case("headerless"); }
TEST_F(ImportCommand, ReadsARowOfUnits) { expect_case("units_row"); }

/// 4 s of two joints on the motor side, in the units of examples/maps/currents.yaml.
std::string motor_log(int rows) {
  std::string text = "t,motor_angle_1,motor_angle_2,motor_current_1,motor_current_2\n";
  for (int k = 0; k < rows; ++k) {
    const double t = 0.002 * k;
    text += std::to_string(2 * k) + "," + std::to_string(101 * 40 * std::sin(3 * t)) + "," +
            std::to_string(-50 * 30 * std::cos(2 * t)) + "," + std::to_string(std::sin(t)) + "," +
            std::to_string(2 * std::cos(t)) + "\n";
  }
  return text;
}

TEST_F(ImportCommand, WritesWhatStandsAtTheJoints) {
  write("log.csv", motor_log(2000));
  const Outcome outcome =
      dynid("import " DYNGEN_MAPS "/currents.yaml " + made("log.csv") + " -o " + made("run.csv"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out;
  const runtime::Recording run = runtime::read_recording(made("run.csv"));
  ASSERT_EQ(run.samples(), 2000);
  const double deg = std::acos(-1) / 180;
  EXPECT_NEAR(run.q(500, 0), 40 * deg * std::sin(3), 1e-8);
  EXPECT_NEAR(run.q(500, 1), 30 * deg * std::cos(2), 1e-8);
  EXPECT_NEAR(run.tau(500, 0), 0.12 * 101 * std::sin(1), 1e-4);
  EXPECT_NEAR(run.tau(500, 1), 0.055 * -50 * 2 * std::cos(1), 1e-4);
}

TEST_F(ImportCommand, JoinsFilesOfOneSignalEach) {
  std::string angles = "t;e1\n", torques = "some program\nt;m1\n";
  for (int k = 0; k < 1000; ++k)
    angles += std::to_string(0.001 * k) + ";" + std::to_string(0.01 * k) + "\n";
  for (int k = 0; k < 500; ++k)
    torques += std::to_string(0.002 * k) + ";" + std::to_string(0.1 * k) + "\n";
  fs::create_directories(folder_ / "day");
  write("day/enc_1.csv", angles);
  write("day/drive_1.csv", torques);
  write("map.yaml",
        "files: {enc: \"enc*.csv\", drive: {name: \"drive*.csv\", skip: 1}}\n"
        "time: {column: t, unit: s}\n"
        "position: {columns: e1, unit: rad, file: enc}\n"
        "torque: {columns: m1, unit: N m, file: drive}\n");
  for (const std::string& logs :
       {made("day"), made("day/drive_1.csv") + " " + made("day/enc_1.csv")}) {
    const Outcome outcome =
        dynid("import " + made("map.yaml") + " " + logs + " -o " + made("run.csv"));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.out;
    const runtime::Recording run = runtime::read_recording(made("run.csv"));
    EXPECT_EQ(run.samples(), 999);
    EXPECT_NEAR(run.tau(501, 0), 25.05, 1e-6);
  }
  const Outcome half =
      dynid("import " + made("map.yaml") + " " + made("day/enc_1.csv") + " -o " + made("x.csv"));
  EXPECT_EQ(half.exit_code, 1);
  EXPECT_THAT(half.out, HasSubstr("map.yaml:1:"));
  EXPECT_THAT(half.out, HasSubstr("found 0 files for 'drive'"));
}

TEST_F(ImportCommand, SaysWhereTheMapIsWrong) {
  write("log.csv", motor_log(50));
  write("map.yaml", "time: {column: t, unit: ms}\nposition: {colums: q, unit: rad}\n");
  const Outcome outcome =
      dynid("import " + made("map.yaml") + " " + made("log.csv") + " -o " + made("run.csv"));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out,
              HasSubstr("map.yaml:2:12: error: unknown key 'colums' in 'position'; did "
                        "you mean 'columns'?"));
  EXPECT_FALSE(fs::exists(made("run.csv")));
  const Outcome usage = dynid("import " + made("map.yaml") + " " + made("log.csv"));
  EXPECT_EQ(usage.exit_code, 2);
  const Outcome same =
      dynid("import " + made("map.yaml") + " " + made("log.csv") + " -o " + made("log.csv"));
  EXPECT_EQ(same.exit_code, 2);
  EXPECT_THAT(same.out, HasSubstr("are the same file"));
}

TEST_F(ImportCommand, LeavesNoFileWhereALogIsRefused) {
  write("log.csv", "\x89HDF\r\n\x1a\n cut off");
  const Outcome outcome =
      dynid("import " DYNGEN_MAPS "/currents.yaml " + made("log.csv") + " -o " + made("run.csv"));
  EXPECT_EQ(outcome.exit_code, 1) << outcome.out;
  EXPECT_FALSE(fs::exists(made("run.csv")));
  EXPECT_FALSE(fs::exists(made("run.csv.part")));
}

TEST_F(ImportCommand, ListsAndGuesses) {
  write("log.csv", motor_log(3000));
  const Outcome list = dynid("import --list " + made("log.csv"));
  EXPECT_EQ(list.exit_code, 0);
  EXPECT_THAT(list.out, HasSubstr("motor_current_2"));
  const Outcome guess = dynid("import --guess " + made("log.csv") + " -o " + made("guess.yaml"));
  EXPECT_EQ(guess.exit_code, 0) << guess.out;
  EXPECT_THAT(guess.out, HasSubstr("to be answered in the map before it can be used"));
  const Outcome refused =
      dynid("import " + made("guess.yaml") + " " + made("log.csv") + " -o " + made("run.csv"));
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.out, HasSubstr("is a question that was not answered"));
}

TEST_F(ImportCommand, TheTutorialOfMotorCurrentsRuns) {
  EXPECT_EQ(run_tutorial("tutorial_motor_currents.md", "motor_currents"), 5);
  // the map of the page is the file's
  const std::string page = content(DYNGEN_SOURCE_DIR "/docs/howto/tutorial_motor_currents.md");
  EXPECT_THAT(
      page, HasSubstr(content(made("map.yaml")).substr(content(made("map.yaml")).find('\n') + 1)));
}

TEST_F(ImportCommand, TheTutorialOfUrdfAndBagRuns) {
  EXPECT_EQ(run_tutorial("tutorial_urdf_and_bag.md", "urdf_and_bag"), 9);
  EXPECT_THAT(content(made("report.html")), HasSubstr("linear_spring"));
  EXPECT_THAT(content(made("identified.robot")), HasSubstr("effect linear_spring joint="));
  EXPECT_THAT(content(made("identified.xml")), HasSubstr("springref="));
  // the truth of record.py: m2 c2 = 0.513 kg m, and viscous friction of 1.8 and 0.7 N m s/rad
  const std::string fitted = content(made("fitted.urdf"));
  double friction[2] = {0, 0};
  std::size_t at = 0;
  for (double& one : friction) {
    at = fitted.find("damping=\"", at + 1) + 9;
    one = std::stod(fitted.substr(at));
  }
  EXPECT_NEAR(friction[0], 1.8, 0.06);
  EXPECT_NEAR(friction[1], 0.7, 0.02);
}

TEST_F(ImportCommand, NamesSignedNumbersThatStandAsUnsigned) {
  std::string text = "time,q1,tau1\n";
  for (int k = 0; k < 2000; ++k) {
    const double t = 0.002 * k;
    const int torque = static_cast<int>(std::lround(300 * std::sin(3 * t)));
    text += std::to_string(t) + "," + std::to_string(std::sin(3 * t)) + "," +
            std::to_string(torque < 0 ? torque + 65536 : torque) + "\n";
  }
  write("log.csv", text);
  const std::string plain =
      "time: {column: time, unit: s}\nposition: {columns: q1, unit: rad}\n"
      "torque: {columns: tau1, unit: N m";
  write("plain.yaml", plain + "}\n");
  write("bits.yaml", plain + ", bits: 16}\n");
  const std::string behind = " " + made("log.csv") + " -o " + made("run.csv");
  const Outcome told = dynid("import " + made("plain.yaml") + behind);
  EXPECT_THAT(told.out, HasSubstr("they look like signed numbers of 16 bits")) << told.out;
  const Outcome right = dynid("import " + made("bits.yaml") + behind);
  EXPECT_EQ(right.exit_code, 0);
  EXPECT_EQ(right.out.find("signed numbers"), std::string::npos) << right.out;
  const runtime::Recording run = runtime::read_recording(made("run.csv"));
  EXPECT_EQ(run.tau.minCoeff(), -300);
  EXPECT_EQ(run.tau.maxCoeff(), 300);
  const Outcome guess = dynid("import --guess " + made("log.csv") + " -o " + made("guess.yaml"));
  EXPECT_THAT(content(made("guess.yaml")), HasSubstr("bits: 16")) << guess.out;
}

TEST_F(ImportCommand, AListThatIsTooShortDropsNoJoint) {
  write("log.csv", motor_log(500));
  for (const std::string list : {"coupling: [[101]]", "gears: [101]"}) {
    write("map.yaml",
          "time: {column: t, unit: ms}\n"
          "position: {columns: \"motor_angle_{n}\", unit: deg, side: motor}\n"
          "torque: {columns: \"motor_current_{n}\", unit: A, side: motor, constant: 0.1 N m/A}\n" +
              list + "\n");
    const std::string behind = " " + made("log.csv") + " -o " + made("run.csv");
    const Outcome outcome = dynid("import " + made("map.yaml") + behind);
    EXPECT_EQ(outcome.exit_code, 1) << outcome.out;
    EXPECT_THAT(outcome.out, HasSubstr("found a list for 1 joints, expected one for 2"));
    EXPECT_THAT(outcome.out, HasSubstr("map.yaml:4:"));
    const Outcome of_robot =
        dynid("import " + made("map.yaml") + behind + " --robot " + made("arm2.robot"));
    EXPECT_EQ(of_robot.exit_code, 1) << of_robot.out;
    EXPECT_THAT(of_robot.out, HasSubstr("map.yaml:4:"));
  }
}

TEST_F(ImportCommand, EveryRunOfSeveralLogsIsFitted) {
  // two periodic runs with another torque each: one alone would have its own offset
  for (const int run : {1, 2}) {
    std::string text = "time,q1,q2,tau1,tau2\n";
    for (int k = 0; k < 4000; ++k) {
      const double t = 0.002 * k, w = std::numbers::pi;
      text += std::to_string(t) + "," + std::to_string(std::sin(w * t)) + "," +
              std::to_string(std::cos(w * t)) + "," + std::to_string(10 * run) + "," +
              std::to_string(-10 * run) + "\n";
    }
    write("log" + std::to_string(run) + ".csv", text);
  }
  write("map.yaml",
        "time: {column: time, unit: s}\nposition: {columns: \"q{n}\", unit: rad}\n"
        "torque: {columns: \"tau{n}\", unit: N m}\n");
  write("plane.robot", "name plane\nnumber_link 2\nd 0 0.5\nsigma 0 0\nFv * *\noff * *\nstop\n");
  const Outcome joined = dynid("import " + made("map.yaml") + " " + made("log1.csv") + " " +
                               made("log2.csv") + " -o " + made("run.csv"));
  ASSERT_EQ(joined.exit_code, 0) << joined.out;
  const Outcome fit = dynid("fit " + made("plane.robot") + " " + made("run.csv") +
                            " --as-recorded --json " + made("fit.json"));
  EXPECT_THAT(fit.out, HasSubstr("2 runs: all of them are used")) << fit.out;
  const ImportJson answer = ImportJson::parse(content(made("fit.json")));
  for (const ImportJson& one : answer.at("parameters")) {
    if (one.at("name") == "OFF1") {
      EXPECT_NEAR(one.at("value").get<double>(), 15, 1) << fit.out;
    }
    if (one.at("name") == "OFF2") {
      EXPECT_NEAR(one.at("value").get<double>(), -15, 1) << fit.out;
    }
  }
}

TEST_F(ImportCommand, TellsWhatVelocitiesSay) {
  std::string text = "time,q1,qd1,tau1\n";
  for (int k = 0; k < 4000; ++k) {
    const double t = 0.002 * k;
    text += std::to_string(t) + "," + std::to_string(std::sin(3 * t)) + "," +
            std::to_string(2 * 3 * std::cos(3 * t)) + "," + std::to_string(std::cos(3 * t)) + "\n";
  }
  write("log.csv", text);
  write("map.yaml",
        "time: {column: time, unit: s}\nposition: {columns: q1, unit: rad}\n"
        "velocity: {columns: qd1, unit: rad/s}\ntorque: {columns: tau1, unit: N m}\n");
  const Outcome outcome =
      dynid("import " + made("map.yaml") + " " + made("log.csv") + " -o " + made("run.csv"));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("qd1 is 2 times what q1 and time say"));
}

/// A motion of arm2 in degrees, as a controller's own file has it.
std::string commanded_log() {
  std::string text = "t_ms,cmd_1,cmd_2,act_1,act_2\n";
  for (int k = 0; k < 400; ++k) {
    const double t = 0.01 * k;
    const double a = 30 * std::sin(2 * t), b = 20 * std::cos(1.5 * t);
    text += std::to_string(10 * k) + "," + std::to_string(a) + "," + std::to_string(b) + "," +
            std::to_string(a + 1) + "," + std::to_string(b - 1) + "\n";
  }
  return text;
}

const std::string kCommandedMap =
    "time: {column: t_ms, unit: ms}\n"
    "position: {columns: \"act_{n}\", unit: deg}\n"
    "commanded: {columns: \"cmd_{n}\", unit: deg}\n";

/// arm2 with numbers.
std::string arm2_with_numbers() {
  std::string text = kArm2;
  for (const std::string row : {"mY", "mZ", "XY", "XZ", "YZ"}) {
    text.replace(text.find("\n" + row + " * *"), row.size() + 5, "\n" + row + " 0 0");
  }
  for (std::size_t at = text.find('*'); at != text.npos; at = text.find('*')) text[at] = '1';
  return text;
}

TEST_F(ImportCommand, SimulateAndAtlasReadTrajectoriesByAMap) {
  write("arm.robot", arm2_with_numbers());
  write("cmd.csv", commanded_log());
  write("map.yaml", kCommandedMap);
  std::string plain = "time,q1,q2\n";
  for (int k = 0; k < 400; ++k) {
    const double t = 0.01 * k, degree = std::numbers::pi / 180;
    plain += std::to_string(t) + "," + std::to_string(30 * degree * std::sin(2 * t)) + "," +
             std::to_string(20 * degree * std::cos(1.5 * t)) + "\n";
  }
  write("plain.csv", plain);
  const Outcome by_map =
      dynid("simulate " + made("arm.robot") + " --trajectory " + made("cmd.csv") + " --map " +
            made("map.yaml") + " -o " + made("a.csv"));
  ASSERT_EQ(by_map.exit_code, 0) << by_map.out;
  const Outcome as_is =
      dynid("simulate " + made("arm.robot") + " --trajectory " + made("plain.csv") + " --map " +
            made("map.yaml") + " -o " + made("b.csv"));
  ASSERT_EQ(as_is.exit_code, 0) << as_is.out;
  EXPECT_THAT(as_is.out, HasSubstr("it is read without the map"));
  const runtime::Recording a = runtime::read_recording(made("a.csv"));
  const runtime::Recording b = runtime::read_recording(made("b.csv"));
  ASSERT_EQ(a.samples(), b.samples());
  EXPECT_LT((a.q - b.q).cwiseAbs().maxCoeff(), 1e-4);
  const Outcome atlas = dynid("atlas " + made("arm.robot") + " --trajectory " + made("cmd.csv") +
                              " --map " + made("map.yaml"));
  EXPECT_EQ(atlas.exit_code, 0) << atlas.out;
  EXPECT_THAT(atlas.out, HasSubstr("4.0 s"));
  const Outcome neither = dynid("atlas " + made("arm.robot") + " --trajectory " +
                                made("arm.robot") + " --map " + made("map.yaml"));
  EXPECT_EQ(neither.exit_code, 1) << neither.out;
  write("other.csv", "a,b\n1,2\n2,3\n3,4\n");
  const Outcome missing = dynid("atlas " + made("arm.robot") + " --trajectory " +
                                made("other.csv") + " --map " + made("map.yaml"));
  EXPECT_EQ(missing.exit_code, 1) << missing.out;
  EXPECT_THAT(missing.out, HasSubstr("map.yaml:3:22: error: found no column 'cmd_1'"));
}

TEST_F(ImportCommand, ExciteSumsUpEarlierRecordingsByAMap) {
  const std::string folder = DYNGEN_SOURCE_DIR "/tests/data/cases/units_row/run.csv.gz";
  const std::string map = " --map " + std::string(DYNGEN_MAPS) + "/units_row.yaml";
  write("arm.robot", kArm2);
  const std::string robot = " " + made("arm.robot") + " ";
  ASSERT_EQ(dynid("accumulate" + robot + folder + map + " -o " + made("first.qr")).exit_code, 0);
  std::string limited = kArm2;
  limited.replace(limited.find("stop"), 4, "qmin -2 -2\nqmax 2 2\nvmax 2 2\namax 10 10\nstop");
  write("limited.robot", limited);
  const std::string command =
      "excite " + made("limited.robot") +
      " --criterion a --evaluations 20 --starts 1 --rate 50 --periods 2 -o ";
  const Outcome of_sum = dynid(command + made("a.csv") + " --prior " + made("first.qr"));
  const Outcome of_log = dynid(command + made("b.csv") + " --prior " + folder + map);
  ASSERT_EQ(of_sum.exit_code, 0) << of_sum.out;
  ASSERT_EQ(of_log.exit_code, 0) << of_log.out;
  EXPECT_EQ(content(made("a.csv")), content(made("b.csv")));
}

TEST_F(ImportCommand, TracksWhatTheLogSaysWasCommanded) {
  write("plane.robot", "name plane\nnumber_link 1\nd 0\nsigma 0\nZZ *\nFv *\noff *\nstop\n");
  std::string text = "t,cmd,act,trq\n";
  for (int k = 0; k < 3000; ++k) {
    const double t = 0.002 * k;
    const double q = std::sin(3 * t) + 0.3 * std::sin(7 * t);
    const double dq = 3 * std::cos(3 * t) + 2.1 * std::cos(7 * t);
    const double ddq = -9 * std::sin(3 * t) - 14.7 * std::sin(7 * t);
    text += std::to_string(t) + "," + std::to_string(q * 180 / std::numbers::pi) + "," +
            std::to_string((q + 1e-4 * std::sin(40 * t)) * 180 / std::numbers::pi) + "," +
            std::to_string(0.5 * ddq + 0.8 * dq + 0.1) + "\n";
  }
  write("log.csv", text);
  write("map.yaml",
        "time: {column: t, unit: s}\nposition: {columns: act, unit: deg}\n"
        "commanded: {columns: cmd, unit: deg}\ntorque: {columns: trq, unit: N m}\n");
  const Outcome fit = dynid("fit " + made("plane.robot") + " " + made("log.csv") + " --map " +
                            made("map.yaml") + " --method iv --tracked " + made("log.csv"));
  EXPECT_EQ(fit.exit_code, 0) << fit.out;
}

TEST_F(ImportCommand, EveryCommandThatReadsMotionTakesAMap) {
  for (const std::string command :
       {"fit", "check", "accumulate", "atlas", "diagnose", "simulate", "excite"}) {
    EXPECT_THAT(dynid(command + " --help").out, HasSubstr("--map")) << command;
  }
}

}  // namespace
}  // namespace dyngen::test
