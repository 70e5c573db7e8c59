// What messages take from files does nothing to a terminal.
#include "text/printable.hpp"

#include <catch2/catch.hpp>
#include <string>

#include "mesher/error.hpp"

using mesher::text::printable;

TEST_CASE("control characters and bytes that are no UTF-8 are written as numbers") {
  CHECK(printable("abc d\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80") ==
        "abc d\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80");
  CHECK(printable("\x1B[31m\a\x7F") == "\\x1b[31m\\x07\\x7f");
  CHECK(printable(std::string("a\0b", 3)) == "a\\x00b");
  CHECK(printable("two\nlines") == "two\nlines");
  CHECK(printable("\xC2\x9B") == "\\xc2\\x9b");                    // a control of 8 bits
  CHECK(printable("\xC0\xAF\xFF") == "\\xc0\\xaf\\xff");           // overlong, and no beginning
  CHECK(printable("\xED\xA0\x80") == "\\xed\\xa0\\x80");           // a surrogate
  CHECK(printable("\xE2\x82") == "\\xe2\\x82");                    // cut
  CHECK(printable("\xF4\x90\x80\x80") == "\\xf4\\x90\\x80\\x80");  // beyond Unicode
}

TEST_CASE("a quotation has some 40 bytes, cut between characters, and no line feeds") {
  CHECK(mesher::text::quoted("a\nb") == "'a\\x0ab'");
  CHECK(mesher::text::quoted(std::string(41, 'x')) == "'" + std::string(40, 'x') + "...'");
  CHECK(mesher::text::quoted(std::string(39, 'x') + "\xC3\xA9") ==
        "'" + std::string(39, 'x') + "...'");
}

TEST_CASE("an error shows nothing else, whatever its message was made of") {
  const mesher::Error error(mesher::ErrorCode::bad_syntax, "expected \x1B]0;x\a",
                            {"a\x1B.msh", 2, 1});
  CHECK(std::string(error.what()) == "a\\x1b.msh:2:1: error[bad_syntax]: expected \\x1b]0;x\\x07");
  CHECK(error.location().file == "a\x1B.msh");
}
