// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/xml/xml_document.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "gen/diagnostic/assert.h"
#include "gen/diagnostic/utf8.h"
#include "gen/xml/attribute_ranges.h"

#if DYNGEN_WITH_EXPAT
#include <expat.h>
#endif

namespace dyngen {

const XmlAttribute* XmlElement::attribute(std::string_view wanted) const {
  for (const XmlAttribute& own : attributes) {
    if (own.name == wanted) return &own;
  }
  return nullptr;
}

const XmlElement* XmlElement::child(std::string_view wanted) const {
  for (const XmlElement& own : children) {
    if (own.name == wanted) return &own;
  }
  return nullptr;
}

#if !DYNGEN_WITH_EXPAT

bool has_xml_reader() { return false; }

XmlDocument parse_xml(std::string, std::string file_name) {
  throw ModelError(fmt::format(
      "{}: error: this is XML: reading URDF and MJCF needs libexpat1-dev when dyngen is built\n",
      file_name));
}

#else

namespace {

/// Takes what expat reports and makes a tree of it.
class XmlTreeReader {
 public:
  XmlTreeReader(std::string text, std::string file_name)
      : parser_(XML_ParserCreate(nullptr), &XML_ParserFree) {
    document_.file_name = std::move(file_name);
    document_.text = std::move(text);
    document_.lines = LineTable(document_.text);
  }

  XmlDocument read() {
    refuse_wide_characters();
    if (!parser_) throw std::bad_alloc();
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(parser_.get(), &XmlTreeReader::on_start, &XmlTreeReader::on_end);
    XML_SetCharacterDataHandler(parser_.get(), &XmlTreeReader::on_text);
    XML_SetStartDoctypeDeclHandler(parser_.get(), &XmlTreeReader::on_doctype);
    const XML_Status status = XML_Parse(parser_.get(), document_.text.data(),
                                        static_cast<int>(document_.text.size()), XML_TRUE);
    if (!refusal_.empty()) fail(refusal_byte_, refusal_, refusal_hint_);
    if (status != XML_STATUS_OK) fail_as_expat_says();
    return std::move(document_);
  }

 private:
  [[noreturn]] void fail(std::size_t byte, const std::string& message, const std::string& hint) {
    Diagnostics diagnostics(document_.file_name, document_.text);
    diagnostics.error(document_.position_of(byte), 1, message, hint);
    throw ModelError(diagnostics.render());
  }

  /// Ranges of bytes are looked for with ASCII's blanks and quotes.
  void refuse_wide_characters() {
    const std::string_view text = document_.text;
    const std::size_t nul = text.find('\0');
    // one of the first two characters of UTF-16 is ASCII
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff") || nul < 2) {
      fail(0, "this XML is UTF-16, or no text", "save the file as UTF-8");
    }
    if (nul != text.npos) fail(nul, "NUL byte: this is no text", "remove it");
  }

  [[noreturn]] void fail_as_expat_says() {
    const XML_Index index = XML_GetCurrentByteIndex(parser_.get());
    const std::size_t byte = index < 0 ? document_.text.size() : static_cast<std::size_t>(index);
    const XML_Error code = XML_GetErrorCode(parser_.get());
    std::string hint = "the file has to be well-formed XML";
    if (code == XML_ERROR_TAG_MISMATCH && !open_.empty()) {
      hint = fmt::format("<{}> of line {} is still open", printable(open_.back().name),
                         open_.back().position.line);
    } else if (code == XML_ERROR_NO_ELEMENTS && !open_.empty()) {
      hint = fmt::format("the text ends inside <{}> of line {}", printable(open_.back().name),
                         open_.back().position.line);
    }
    fail(byte, fmt::format("XML: {}", XML_ErrorString(code)), hint);
  }

  /// Reading goes on to the end of the piece that expat is at, and is over then.
  void refuse(const std::string& message, const std::string& hint) {
    if (!refusal_.empty()) return;
    refusal_ = message;
    refusal_hint_ = hint;
    refusal_byte_ = static_cast<std::size_t>(XML_GetCurrentByteIndex(parser_.get()));
    XML_StopParser(parser_.get(), XML_FALSE);
  }

  /// The place of a byte behind the last one that was asked for, without going through a long line
  /// from its beginning again.
  SourcePosition position_at(std::size_t byte) {
    const std::string_view text = document_.text;
    const std::string_view between = text.substr(last_byte_, byte - last_byte_);
    const std::size_t line_end = between.rfind('\n');
    if (line_end == between.npos) {
      last_position_.column += character_count(between);
    } else {
      last_position_ = document_.position_of(byte);
    }
    last_byte_ = byte;
    return last_position_;
  }

  void start(const char* name, const char** attributes) {
    if (open_.size() >= static_cast<std::size_t>(kMaxXmlDepth)) {
      refuse(fmt::format("elements stand in each other {} deep", kMaxXmlDepth + 1),
             "no robot's description is that deep");
      return;
    }
    XmlElement element;
    element.name = name;
    const auto begin = static_cast<std::size_t>(XML_GetCurrentByteIndex(parser_.get()));
    const auto size = static_cast<std::size_t>(XML_GetCurrentByteCount(parser_.get()));
    element.start_tag = {begin, begin + size};
    const std::string_view tag = std::string_view(document_.text).substr(begin, size);
    element.self_closing = tag.ends_with("/>");
    element.position = position_at(begin);
    element.length = 1 + character_count(element.name);
    const std::vector<AttributeRange> ranges = attribute_ranges(tag, begin);
    for (std::size_t i = 0; attributes[2 * i] != nullptr; ++i) {
      DYNGEN_ASSERT(i < ranges.size(), "an attribute was not found in its tag");
      XmlAttribute attribute;
      attribute.name = attributes[2 * i];
      attribute.value = attributes[2 * i + 1];
      attribute.name_bytes = ranges[i].name;
      attribute.value_bytes = ranges[i].value;
      attribute.position = position_at(ranges[i].value.begin);
      attribute.length =
          std::max(1, character_count(std::string_view(document_.text)
                                          .substr(ranges[i].value.begin, ranges[i].value.size())));
      element.attributes.push_back(std::move(attribute));
    }
    open_.push_back(std::move(element));
  }

  void end() {
    if (open_.empty()) return;
    XmlElement element = std::move(open_.back());
    open_.pop_back();
    if (element.self_closing) {
      element.content = {element.start_tag.end, element.start_tag.end};
      element.whole = element.start_tag;
    } else {
      const auto begin = static_cast<std::size_t>(XML_GetCurrentByteIndex(parser_.get()));
      const auto size = static_cast<std::size_t>(XML_GetCurrentByteCount(parser_.get()));
      element.content = {element.start_tag.end, begin};
      element.whole = {element.start_tag.begin, begin + size};
    }
    if (open_.empty()) {
      document_.root = std::move(element);
    } else {
      open_.back().children.push_back(std::move(element));
    }
  }

  template <class Action>
  static void guarded(void* self, const Action& action) {
    auto* reader = static_cast<XmlTreeReader*>(self);
    if (!reader->refusal_.empty()) return;
    try {
      action(*reader);
    } catch (const std::exception& error) {  // nothing may fly through a library written in C
      reader->refuse(error.what(), {});
    }
  }
  static void XMLCALL on_start(void* self, const XML_Char* name, const XML_Char** attributes) {
    guarded(self, [&](XmlTreeReader& reader) { reader.start(name, attributes); });
  }
  static void XMLCALL on_end(void* self, const XML_Char*) {
    guarded(self, [](XmlTreeReader& reader) { reader.end(); });
  }
  static void XMLCALL on_text(void* self, const XML_Char* text, int size) {
    guarded(self, [&](XmlTreeReader& reader) {
      if (reader.open_.empty()) return;
      reader.open_.back().text.append(text, static_cast<std::size_t>(size));
    });
  }
  static void XMLCALL on_doctype(void* self, const XML_Char*, const XML_Char*, const XML_Char*,
                                 int has_internal_subset) {
    guarded(self, [&](XmlTreeReader& reader) {
      if (has_internal_subset == 0) return;
      reader.refuse("a document type with declarations of its own is not read",
                    "write out what its entities stand for, and delete <!DOCTYPE ...>");
    });
  }

  std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser_;
  XmlDocument document_;
  std::vector<XmlElement> open_;  // from the root on
  std::string refusal_, refusal_hint_;
  std::size_t refusal_byte_ = 0;
  std::size_t last_byte_ = 0;
  SourcePosition last_position_{1, 1};
};

}  // namespace

bool has_xml_reader() { return true; }

XmlDocument parse_xml(std::string text, std::string file_name) {
  return XmlTreeReader(std::move(text), std::move(file_name)).read();
}

#endif

}  // namespace dyngen
