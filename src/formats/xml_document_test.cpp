// What is said of files that are not well-formed XML.
#include <gtest/gtest.h>

#include "formats/reader_testing.h"

namespace norrsken {
namespace {

TEST(XmlErrors, EmptyFile) {
  EXPECT_EQ(complaints_about(R"()"),
            R"(room.xml: error: 'room.xml' is empty, not a scene
accepted: a file with a <scene> in it)");
}

TEST(XmlErrors, BlankFile) {
  EXPECT_EQ(complaints_about(R"( 
	
)"),
            R"(room.xml: error: 'room.xml' is empty, not a scene
accepted: a file with a <scene> in it)");
}

TEST(XmlErrors, OnlyAComment) {
  EXPECT_EQ(complaints_about(R"(<!-- nothing -->)"),
            R"(room.xml: error: the file has no elements
accepted: <scene version="3.0.0"> ... </scene>)");
}

TEST(XmlErrors, NotXmlAtAll) {
  EXPECT_EQ(complaints_about(R"(hello)"),
            R"(room.xml: error: 'room.xml' is plain text, not a scene
accepted: a scene of Mitsuba's XML, which begins with <scene version="3.0.0">)");
}

TEST(XmlErrors, UnclosedRoot) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <bsdf type="diffuse"/>
)"),
            R"(room.xml:1:1: error: <scene> is never closed
    1 | <scene version="3.0.0">
      | ^~~~~~
accepted: </scene>)");
}

TEST(XmlErrors, UnclosedElement) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <shape type="sphere">
    <bsdf type="diffuse">
  </shape>
</scene>)"),
            R"(room.xml:4:3: error: </shape> where <bsdf> of line 3 is open
    4 |   </shape>
      |   ^~~~~~~~
accepted: </bsdf>)");
}

TEST(XmlErrors, ClosingTagTooMany) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
</scene>
</scene>)"),
            R"(room.xml:3:1: error: </scene> closes nothing
    3 | </scene>
      | ^~~~~~~~)");
}

TEST(XmlErrors, UnclosedComment) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <!-- a comment - - >
  <bsdf type="diffuse"/>
</scene>)"),
            R"(room.xml:2:3: error: the comment is never closed
    2 |   <!-- a comment - - >
      |   ^~~~
accepted: -->)");
}

TEST(XmlErrors, UnclosedQuote) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <bsdf type="diffuse/>
  <bsdf type="diffuse"/>
</scene>)"),
            R"(room.xml:2:14: error: the value of attribute 'type' has no closing quote
    2 |   <bsdf type="diffuse/>
      |              ^
accepted: a closing ")");
}

TEST(XmlErrors, NoQuotes) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <float name="fov" value=45/>
</scene>)"),
            R"(room.xml:2:21: error: the value of attribute 'value' has no quotes
    2 |   <float name="fov" value=45/>
      |                     ^~~~~
accepted: value="...")");
}

TEST(XmlErrors, AttributeWithoutValue) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <float name="fov" value/>
</scene>)"),
            R"(room.xml:2:21: error: attribute 'value' has no value
    2 |   <float name="fov" value/>
      |                     ^~~~~
accepted: value="...")");
}

TEST(XmlErrors, NoBlankBetweenAttributes) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <float name="fov"value="45"/>
</scene>)"),
            R"(room.xml:2:20: error: no blank between two attributes
    2 |   <float name="fov"value="45"/>
      |                    ^
accepted: a blank)");
}

TEST(XmlErrors, TagWithoutEnd) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <bsdf type="diffuse"
  <bsdf type="diffuse"/>
</scene>)"),
            R"(room.xml:2:3: error: the tag <bsdf has no '>'
    2 |   <bsdf type="diffuse"
      |   ^~~~~
accepted: '>' or '/>')");
}

TEST(XmlErrors, LessThanInText) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  < bsdf/>
</scene>)"),
            R"(room.xml:2:3: error: '<' without a name
    2 |   < bsdf/>
      |   ^
accepted: &lt; for the character itself)");
}

TEST(XmlErrors, StrayCharacterInTag) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <bsdf type="diffuse" = />
</scene>)"),
            R"(room.xml:2:24: error: unexpected '=' in the tag <bsdf>
    2 |   <bsdf type="diffuse" = />
      |                        ^
accepted: name="value", '>' or '/>')");
}

TEST(XmlErrors, SecondRoot) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0"/>
<scene version="3.0.0"/>)"),
            R"(room.xml:2:1: error: a second element at the top
    2 | <scene version="3.0.0"/>
      | ^~~~~~
accepted: one element with everything else inside)");
}

TEST(XmlErrors, TextBesideTheRoot) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0"/>
hello)"),
            R"(room.xml:2:1: error: text outside of the root element
    2 | hello
      | ^~~~~
accepted: one element with everything else inside)");
}

}  // namespace
}  // namespace norrsken
