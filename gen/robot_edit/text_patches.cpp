// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/robot_edit/text_patches.h"

#include <algorithm>

#include "gen/diagnostic/assert.h"

namespace dyngen {

namespace {

/// The blanks in front of an element, if nothing else stands before it on its line.
std::string indentation_of(const XmlDocument& document, const XmlElement& element) {
  const std::string_view before = std::string_view(document.text).substr(0, element.whole.begin);
  const std::size_t line = before.rfind('\n');
  const std::string_view blanks = line == before.npos ? before : before.substr(line + 1);
  return blanks.find_first_not_of(" \t") == blanks.npos ? std::string(blanks) : std::string();
}

}  // namespace

void TextPatches::replace(ByteRange range, std::string text) {
  patches_.push_back({range, std::move(text)});
}

std::string TextPatches::applied(std::string_view text) const {
  std::vector<Patch> ordered = patches_;
  std::stable_sort(ordered.begin(), ordered.end(), [](const Patch& a, const Patch& b) {
    return a.range.begin != b.range.begin ? a.range.begin < b.range.begin
                                          : a.range.end < b.range.end;
  });
  std::string result;
  std::size_t done = 0;
  for (const Patch& patch : ordered) {
    DYNGEN_ASSERT(patch.range.begin >= done && patch.range.begin <= patch.range.end &&
                      patch.range.end <= text.size(),
                  "changes do not overlap");
    result += text.substr(done, patch.range.begin - done);
    result += patch.text;
    done = patch.range.end;
  }
  result += text.substr(done);
  return result;
}

void set_attribute(TextPatches& patches, const XmlElement& element, std::string_view name,
                   std::string_view value) {
  if (const XmlAttribute* attribute = element.attribute(name)) {
    patches.replace(attribute->value_bytes, std::string(value));
    return;
  }
  const std::size_t behind_name = element.start_tag.begin + 1 + element.name.size();
  // behind the quote of the last attribute
  const std::size_t at =
      element.attributes.empty() ? behind_name : element.attributes.back().value_bytes.end + 1;
  patches.insert(at, " " + std::string(name) + "=\"" + std::string(value) + "\"");
}

void insert_child(TextPatches& patches, const XmlDocument& document, const XmlElement& element,
                  const std::string& child) {
  const std::string own = indentation_of(document, element);
  const std::string line = "\n" + own + "  " + child;
  if (element.self_closing) {
    const std::size_t slash = element.start_tag.end - 2;  // of "/>"
    patches.replace({slash, element.start_tag.end},
                    ">" + line + "\n" + own + "</" + element.name + ">");
    return;
  }
  const std::string_view content =
      std::string_view(document.text).substr(element.content.begin, element.content.size());
  const bool on_one_line = content.find('\n') == content.npos;
  patches.insert(element.content.begin, on_one_line ? line + "\n" + own : line);
}

const XmlElement* element_at(const XmlElement& root, SourcePosition position) {
  if (root.position.line == position.line && root.position.column == position.column) return &root;
  for (const XmlElement& child : root.children) {
    if (const XmlElement* found = element_at(child, position)) return found;
  }
  return nullptr;
}

void insert_comment(TextPatches& patches, const XmlDocument& document,
                    const std::vector<std::string>& lines) {
  std::string text = "\n  <!--\n", before;
  bool empty = true;
  for (const std::string& line : lines) {
    if (line.empty()) {
      before = empty ? "" : "\n";  // between paragraphs, one
      continue;
    }
    text += before + "    " + line + "\n";
    before.clear();
    empty = false;
  }
  if (empty) return;
  for (std::size_t at = text.find("--", 8); at != text.npos; at = text.find("--", at)) {
    text.insert(at + 1, " ");
  }
  if (document.root.self_closing) return;
  patches.insert(document.root.start_tag.end, text + "  -->");
}

}  // namespace dyngen
