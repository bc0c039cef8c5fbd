// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace dyngen::runtime {

/// What a curve or a bar stands for: gives its colour on the page and in pictures.
enum class Role {
  kData,      ///< measured
  kModel,     ///< what a model says
  kBefore,    ///< left by the model alone
  kAfter,     ///< left with what was found
  kFloor,     ///< the noise
  kForward,   ///< while the joint moves forward
  kBackward,  ///< while it moves backward
};
/// "data", "model", ...
const char* role_name(Role role);

/// A curve over the x of its panel.
struct ReportSeries {
  std::string name;  ///< in the key; empty: not there
  Role role = Role::kData;
  Eigen::VectorXd y;          ///< (N); NaN: a gap
  Eigen::VectorXd low, high;  ///< (N) its band; empty: none
  bool dashed = false;
  bool marks = false;  ///< a mark at each value
};

/// Single samples; they have an x of their own.
struct ReportCloud {
  std::string name;
  Role role = Role::kData;
  Eigen::VectorXd x, y;
};

/// A part of the x axis that is shaded.
struct ReportSpan {
  double from = 0, to = 0;
  std::string label;
};

/// A diagram with its own axes.
struct ReportPanel {
  std::string x_label, y_label;
  Eigen::VectorXd x;  ///< (N) ascending
  std::vector<ReportSeries> series;
  std::vector<ReportCloud> clouds;
  std::vector<ReportSpan> spans;
};

/// The same thing seen another way: over another variable, in another recording.
struct ReportView {
  std::string name;
  std::vector<ReportPanel> panels;  ///< one under the other, with one x axis
};

/// A chart that is zoomed, read and printed.
struct ReportChart {
  std::string id;       ///< unique; the name of its files, a-z 0-9 and '-'
  std::string title;    ///< what it shows, a line
  std::string caption;  ///< how to read it
  std::vector<ReportView> views;
  std::string choice = "recording";  ///< what views are, where they have no samples
  std::string same_as{};             ///< id of the chart whose views it shows; empty: its own
};

struct ReportBar {
  std::string name;
  Role role = Role::kData;
  double value = 0;  ///< NaN: not known
};
struct ReportBarGroup {
  std::string label, unit;
  bool marked = false;
  std::vector<ReportBar> bars;
};
/// Numbers side by side as bars; each group has its own scale.
struct ReportBars {
  std::string id, title, caption;
  std::vector<ReportBarGroup> groups;
};

/// A square table as colours: how alike things are.
struct ReportMatrix {
  std::string id, title, caption;
  std::vector<std::string> names;  ///< of rows and columns
  Eigen::MatrixXd values;          ///< (names x names) 0 to 1
};

/// Plain words.
struct ReportText {
  enum class Tone { kPlain, kQuiet, kVerdict };
  std::string text;
  Tone tone = Tone::kPlain;
};

struct ReportList {
  std::vector<std::string> items;
};

/// A few numbers that matter.
struct ReportFacts {
  struct Fact {
    std::string label, value, note;
  };
  std::vector<Fact> items;
};

/// Text, or a number of four digits that stands on the right.
struct ReportCell {
  ReportCell(std::string words) : text(std::move(words)) {}      // NOLINT: rows are lists of cells
  ReportCell(const char* words) : text(words) {}                 // NOLINT
  ReportCell(double number) : value(number), is_number(true) {}  // NOLINT
  std::string text;
  double value = std::numeric_limits<double>::quiet_NaN();
  bool is_number = false;
};
struct ReportTable {
  std::vector<std::string> header;
  std::vector<std::vector<ReportCell>> rows;  ///< of as many cells as the header
  std::size_t shown = 0;                      ///< rows; the others open on request. 0: all
};

/// Program text or a command, as it is.
struct ReportCode {
  std::string text;
};

/// Formulas as effect files spell them, a line each; typeset by the page.
struct ReportFormula {
  std::vector<std::string> lines;
};

/// An arm as lines in space.
struct ReportArm {
  using Point = std::array<double, 3>;
  struct Joint {
    std::string label;
    int coordinate = -1;  ///< from 0; -1: fixed
    bool prismatic = false;
    Point at{}, axis{};       ///< where it is, m, and its direction
    std::vector<Point> link;  ///< from the parent's frame to its own
    bool marked = false;
  };
  std::vector<Joint> joints;
  Point up{0, 0, 1};  ///< against gravity
};

using ReportBlock = std::variant<ReportText, ReportList, ReportFacts, ReportTable, ReportCode,
                                 ReportFormula, ReportBars, ReportMatrix, ReportChart, ReportArm>;

/// Blocks under a small heading: "WHERE".
struct ReportPart {
  std::string id, word, title;  ///< the word may be empty
  std::vector<ReportBlock> blocks;
};

struct ReportSection {
  enum class Kind {
    kFirst,    ///< the first screen: arm and bars side by side
    kFinding,  ///< begins a page when printed
    kPlain
  };
  std::string id, title;
  Kind kind = Kind::kPlain;
  std::vector<ReportPart> parts;
};

/// What a page tells, in its order. Knows no command: diagnose, fit, excite and atlas can fill it.
struct ReportDocument {
  std::string kind;             ///< "diagnosis"
  std::string title, subtitle;  ///< the robot; what was done
  std::string state;            ///< a word for how it ended, which gives its colour; may be empty
  std::string state_text;       ///< the same for people
  std::string origin;           ///< the foot of the page: versions
  std::vector<ReportSection> sections;

  /// @throws std::invalid_argument  if lengths or sizes differ, an id is used twice or has other
  ///         characters
  void validate() const;
};

/// All charts, bars and matrices of a document, in its order; charts that show the views of others
/// too.
std::vector<const ReportChart*> charts_of(const ReportDocument& document);
std::vector<const ReportBars*> bars_of(const ReportDocument& document);
std::vector<const ReportMatrix*> matrices_of(const ReportDocument& document);

}  // namespace dyngen::runtime
