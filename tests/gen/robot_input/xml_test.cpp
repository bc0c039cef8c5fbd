// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <clocale>
#include <string>
#include <string_view>

#include "gen/xml/decimal_number.h"
#include "gen/xml/xml_document.h"

namespace dyngen {
namespace {

std::string_view piece(const XmlDocument& document, const ByteRange& range) {
  return std::string_view(document.text).substr(range.begin, range.size());
}

std::string xml_error(const std::string& text) {
  try {
    (void)parse_xml(text, "a.xml");
    return "";
  } catch (const ModelError& error) {
    return error.what();
  }
}

TEST(Xml, RangesAreThoseOfTheText) {
  const XmlDocument document = parse_xml(
      "<?xml version=\"1.0\"?>\n<!-- <a x='0'/> -->\n<a one = '1 > 2'\n   two=\"&lt;3&#x41;\">"
      "text<b/>more<c z=\"\">in</c >\n</a>\n",
      "a.xml");
  const XmlElement& a = document.root;
  EXPECT_EQ(a.name, "a");
  ASSERT_EQ(a.attributes.size(), 2U);
  EXPECT_EQ(a.attributes[0].name, "one");
  EXPECT_EQ(a.attributes[0].value, "1 > 2");
  EXPECT_EQ(piece(document, a.attributes[0].value_bytes), "1 > 2");
  EXPECT_EQ(piece(document, a.attributes[0].name_bytes), "one");
  EXPECT_EQ(a.attributes[1].value, "<3A");
  EXPECT_EQ(piece(document, a.attributes[1].value_bytes), "&lt;3&#x41;");
  EXPECT_EQ(a.attributes[1].position.line, 4);
  EXPECT_EQ(a.attributes[1].position.column, 9);
  EXPECT_EQ(piece(document, a.start_tag), "<a one = '1 > 2'\n   two=\"&lt;3&#x41;\">");
  EXPECT_EQ(piece(document, a.content), "text<b/>more<c z=\"\">in</c >\n");
  EXPECT_EQ(document.text.substr(a.whole.end), "\n");
  EXPECT_EQ(a.text, "textmore\n");
  ASSERT_EQ(a.children.size(), 2U);
  const XmlElement& b = a.children[0];
  EXPECT_TRUE(b.self_closing);
  EXPECT_EQ(piece(document, b.whole), "<b/>");
  EXPECT_EQ(b.content, (ByteRange{b.whole.end, b.whole.end}));
  const XmlElement& c = a.children[1];
  EXPECT_FALSE(c.self_closing);
  EXPECT_EQ(piece(document, c.whole), "<c z=\"\">in</c >");
  EXPECT_EQ(piece(document, c.content), "in");
  EXPECT_EQ(c.attributes[0].value_bytes.size(), 0U);
  EXPECT_EQ(c.position.line, 4);
}

TEST(Xml, RangesCountAMarkOfUtf8AndCharactersOfSeveralBytes) {
  const XmlDocument document = parse_xml("\xef\xbb\xbf<r \xc3\xa9='\xc3\xbc' n='2'/>", "a.xml");
  EXPECT_EQ(piece(document, document.root.start_tag), "<r \xc3\xa9='\xc3\xbc' n='2'/>");
  ASSERT_EQ(document.root.attributes.size(), 2U);
  EXPECT_EQ(piece(document, document.root.attributes[1].value_bytes), "2");
  EXPECT_EQ(document.root.attributes[0].value, "\xc3\xbc");
}

TEST(Xml, RangesAreBytesInLatin1) {
  const XmlDocument document =
      parse_xml("<?xml version='1.0' encoding='ISO-8859-1'?>\n<r a='\xe4\xf6' n='2'/>", "a.xml");
  EXPECT_EQ(document.root.attributes[0].value, "\xc3\xa4\xc3\xb6");
  EXPECT_EQ(piece(document, document.root.attributes[0].value_bytes), "\xe4\xf6");
  EXPECT_EQ(piece(document, document.root.attributes[1].value_bytes), "2");
}

TEST(Xml, WrongTextsAreRefusedWithTheirPlace) {
  EXPECT_TRUE(xml_error("<a>\n<b></a>").starts_with("a.xml:2:")) << xml_error("<a>\n<b></a>");
  EXPECT_NE(xml_error("<a>\n<b></a>").find("<b> of line 2"), std::string::npos);
  EXPECT_NE(xml_error("<a x='1' x='2'/>"), "");
  EXPECT_NE(xml_error(""), "");
  EXPECT_NE(xml_error("<a/><b/>"), "");
  EXPECT_NE(xml_error(std::string("\xff\xfe<\0a\0/\0>\0", 10)).find("UTF-8"), std::string::npos);
  const std::string entity = xml_error("<!DOCTYPE a [<!ENTITY b \"bbbb\">]>\n<a>&b;</a>");
  EXPECT_NE(entity.find("document type"), std::string::npos) << entity;
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  EXPECT_NE(xml_error(deep).find("deep"), std::string::npos);
}

TEST(Xml, NumbersAreReadWhateverTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* locale : {"de_DE.UTF-8", "de_DE", "C"}) {
    if (std::setlocale(LC_ALL, locale) == nullptr) continue;
    EXPECT_EQ(read_decimal(" 1.5 "), 1.5L) << locale;
    EXPECT_FALSE(read_decimal("1,5")) << locale;
  }
  std::setlocale(LC_ALL, before.c_str());
  EXPECT_EQ(read_decimal("+2e-3"), 2e-3L);
  EXPECT_EQ(read_decimal("-.5"), -0.5L);
  for (const char* wrong : {"", "1 2", "nan", "inf", "0x10", "1e999", "--1", "+-1", "e5", "1d3"}) {
    EXPECT_FALSE(read_decimal(wrong)) << wrong;
  }
}

}  // namespace
}  // namespace dyngen
