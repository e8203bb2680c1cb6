// Tables as programs, spreadsheets and testing machines write them: read with the right numbers, or refused with the
// line, the cause and the option that settles it.
#include "fpz/io/csv.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fpz/io/csv_options.hpp"
#include "fpz/io/input_error.hpp"

namespace fpz::io {
namespace {

using namespace std::string_literals;

/// What every file of one table below must give.
void expect_table(const Table& t) {
  ASSERT_EQ(t.rows(), 3U);
  EXPECT_EQ(t.columns[t.index("CMOD").value()], (std::vector<double>{0.0, 0.004, 12.5})) << t.notation;
  EXPECT_EQ(t.columns[t.index("Kraft").value()], (std::vector<double>{-0.25, 1.06826, 1234.5})) << t.notation;
}

Table read(const std::string& text, const CsvOptions& options = {}) { return parse_csv(text, "x.csv", options); }

std::string refusal(const std::string& text, const CsvOptions& options = {}) {
  try {
    const Table t = read(text, options);
    return "read: " + t.notation;
  } catch (const InputError& e) {
    return e.what();
  }
}

void expect_refused(const std::string& text, const std::vector<std::string>& words, const CsvOptions& options = {}) {
  const std::string why = refusal(text, options);
  EXPECT_EQ(why.find("read: "), std::string::npos) << text;
  for (const std::string& w : words) EXPECT_NE(why.find(w), std::string::npos) << why << "\nlacks: " << w;
}

std::string in_utf16(const std::string& ascii, bool big) {
  std::string bytes;
  for (const char c : ascii) bytes += big ? std::string{'\0', c} : std::string{c, '\0'};
  return bytes;
}

const std::string plain = "CMOD,Kraft\n0,-0.25\n0.004,1.06826\n12.5,1234.5\n";

TEST(Csv, OneTableInManyNotations) {
  const std::vector<std::string> files = {
      plain,
      "\xEF\xBB\xBF" + plain,
      "CMOD,Kraft\r\n0,-0.25\r\n0.004,1.06826\r\n12.5,1234.5\r\n",
      "CMOD,Kraft\r0,-0.25\r0.004,1.06826\r12.5,1234.5",
      "CMOD;Kraft\n0,0;-0,25\n0,004;1,06826\n12,5;1234,5\n",
      "CMOD;Kraft\n0,0;-0,25\n0,004;1,06826\n12,5;1.234,5\n",
      "CMOD;Kraft\n0,0;-0,25\n0,004;1,06826\n12,5;1'234,5\n",
      "CMOD;Kraft\n0,0;-0,25\n0,004;1,06826\n12,5;1 234,5\n",
      "CMOD;Kraft\n0,0;-0,25\n0,004;1,06826\n12,5;1\xC2\xA0"
      "234,5\n",
      "CMOD\tKraft\n0\t-0,25\n0,004\t1,06826\n12,5\t1234,5\n",
      "CMOD\tKraft\n0\t-0.25\n0.004\t1.06826\n12.5\t1,234.5\n",
      "CMOD|Kraft\n0|-0.25\n0.004|1.06826\n12.5|1234.5\n",
      "  CMOD    Kraft\n  0.0    -0.25\n  0.004   1.06826\n 12.5   1234.5\n",
      "CMOD Kraft\n0 -0,25\n0,004 1,06826\n12,5 1234,5\n",
      "\"CMOD\",\"Kraft\"\n\"0,000\",\"-0,25\"\n\"0,004\",\"1,06826\"\n\"12,5\",\"1234,5\"\n",
      "\"CMOD\",\"Kraft\"\n0.0,-0.25\n0.004,1.06826\n12.5,\"1,234.5\"\n",
      "CMOD;Kraft;\n0;-0,25;\n0,004;1,06826;\n12,5;1234,5;\n",
      "CMOD;Kraft\n0;-0,25;\n0,004;1,06826;\n12,5;1234,5;\n",
      "CMOD,Kraft\n0E+00,-2.5e-1\n4.0D-03,+1.06826\n1.25E1,1.2345e+03\n",
      "CMOD;Kraft\n0;\xE2\x88\x92"
      "0,25\n0,004;1,06826\n12,5;1234,5\n",
      "# CMOD Kraft\n0 -0.25\n0.004 1.06826\n12.5 1234.5\n",
      in_utf16(plain, false),
      in_utf16(plain, true),
      "\xFF\xFE" + in_utf16(plain, false),
      "\xFE\xFF" + in_utf16(plain, true),
  };
  for (const std::string& file : files) {
    SCOPED_TRACE(file);
    expect_table(read(file));
  }
}

TEST(Csv, WhatStandsAroundTheTable) {
  const std::vector<std::string> files = {
      "MTS793|MPT|DEU|1|2|,|.|:|1|0|0|A\r\n\r\nDatenerfassung: Zeitgesteuert\t\t\tZeit: "
      "12,5\ts\r\nCMOD\tWeg\tKraft\tZeit\r\n"
      "mm\tmm\tkN\tsec\r\n0,0\t0,1\t-0,25\t0,5\r\n0,004\t0,2\t1,06826\t1,0\r\n12,5\t0,3\t1234,5\t1,5\r\n",
      "Probe;D50\nTiefe;100;mm\nSpannweite;225,5;mm\n\nCMOD;Kraft\n0;-0,25\n0,004;1,06826\n12,5;1234,5\n",
      "Tiefe;100\nCMOD;Kraft\n0;-0,25\n0,004;1,06826\n12,5;1234,5\n",
      "CMOD,Kraft\n(mm),(kN)\n0,-0.25\n0.004,1.06826\n12.5,1234.5\n",
      "\"CMOD\";\"Kraft\"\n\"mm\";\"kN\"\n0;-0,25\n0,004;1,06826\n12,5;1234,5\n\nMaximum;1234,5\nPruefung beendet\n",
      "CMOD,Kraft\n0,-0.25\nCMOD,Kraft\n0.004,1.06826\n\n12.5,1234.5\nEnd of test\n",
      "CMOD;Kraft\nmm;kN\n0;-0,25\nPumpe an\n0,004;1,06826\nCMOD;Kraft\nmm;kN\n12,5;1234,5\n",
      "# depth = 0.1, 0.2\n# 1, 2\n# made by hand\nCMOD,Kraft\n0,-0.25\n0.004,1.06826\n12.5,1234.5\n",
      "Datum;Uhrzeit;CMOD;Kraft\n01.02.2020;12:00:01;0;-0,25\n01.02.2020;12:00:02;0,004;1,06826\n01.02.2020;12:00:03;"
      "12,5;1234,5\n",
      "Name \"A\",\"Zugabe\nin mm\",CMOD,Kraft\nx,1,0,-0.25\ny,2,0.004,1.06826\nz,3,12.5,1234.5\n",
  };
  for (const std::string& file : files) {
    SCOPED_TRACE(file);
    expect_table(read(file));
  }
}

TEST(Csv, SaysHowItReadAndWhatItLeftOut) {
  const Table t = read(
      "Test 7\nCMOD;Kraft\nmm;kN\n0;-0,25\nPumpe an\n0,004;1,06826\nCMOD;Kraft\n12,5;1234,5\nMaximum;1234,5\nEnde\n");
  EXPECT_EQ(
      t.notation,
      "utf-8, 2 columns at each semicolon, decimal comma, names in line 2, units in line 3, 3 rows in lines 4 to 8");
  EXPECT_EQ(t.lines, (std::vector<std::size_t>{4, 6, 8}));
  EXPECT_EQ(t.units, (std::vector<std::string>{"mm", "kN"}));
  ASSERT_EQ(t.remarks.size(), 3U);
  EXPECT_EQ(t.remarks[0], "x.csv:5: no numbers; left out: Pumpe an");
  EXPECT_EQ(t.remarks[1], "x.csv:7: the line of column names or units again; left out");
  EXPECT_EQ(t.remarks[2], "x.csv:9: text behind the rows from here on; left out: Maximum;1234,5");
}

TEST(Csv, UnitsInNames) {
  const Table t = read("CMOD [m],Load (N),K (MPa.sqrt(m)),Ratio (of two)\n1,2,3,4\n");
  EXPECT_EQ(t.units, (std::vector<std::string>{"m", "N", "MPa.sqrt(m)", ""}));
  EXPECT_EQ(t.at("CMOD"), std::vector<double>{1.0});
  EXPECT_EQ(t.at("Load (N)"), std::vector<double>{2.0});
  EXPECT_EQ(t.index("K"), 2U);
  EXPECT_THROW((void)t.at("K"), InputError);  // who asks by name alone takes the numbers for SI
  EXPECT_EQ(t.find("Ratio"), nullptr);
}

TEST(Csv, MissingCellsAreNoNumbers) {
  const Table t = read("a;b;c\n1;2;3\n4;;n/a\n7;ERR;nan\n8;9;10\n");
  EXPECT_EQ(t.at("a"), (std::vector<double>{1, 4, 7, 8}));
  EXPECT_TRUE(std::isnan(t.at("b")[1]) && std::isnan(t.at("b")[2]));
  EXPECT_TRUE(std::isnan(t.at("c")[1]) && std::isnan(t.at("c")[2]));
}

TEST(Csv, TextColumnsAreKept) {
  const Table t = read("series,value,status,folder\nruns,0,finished,a/b\nruns,1,failed,\"a,c\"\n");
  EXPECT_EQ(t.at("value"), (std::vector<double>{0, 1}));
  EXPECT_TRUE(std::isnan(t.at("folder")[0]));
}

TEST(Csv, AmbiguousNumbersAreRefused) {
  // 1,234 and 1.234 may be one thousand and more, or one and a bit.
  expect_refused("a;b\n1,234;2,345\n3,456;4,567\n", {"x.csv:2: ", "1,234 can be 1234", "\"decimal\": \"comma\""});
  expect_refused("a\tb\n1.234\t2.345\n", {"x.csv:2: ", "1.234 can be 1234", "\"decimal\": \"point\""});
  expect_refused("\"a\",\"b\"\n\"1,234\",\"2,345\"\n", {"1,234 can be 1234"});
  // A decimal point is shown by 0.5; then 1,234 would be grouped, and nothing else is.
  expect_refused("a;b\n0.5;1,234\n", {"x.csv:2: 1,234", "0.5", "\"decimal\""});
  expect_refused("a;b\n0,5;1.234\n", {"x.csv:2: 1.234", "0,5", "\"decimal\""});
  expect_refused("a;b\n0,5;1\n0.7;2\n", {"0,5 in line 2 has a decimal comma", "0.7 in line 3 a decimal point"});
  // Stated, they are read.
  CsvOptions o;
  o.decimal = DecimalMark::comma;
  EXPECT_EQ(read("a;b\n1,234;1.234\n", o).at("a"), std::vector<double>{1.234});
  EXPECT_EQ(read("a;b\n1,234;1.234\n", o).at("b"), std::vector<double>{1234.0});
  o.decimal = DecimalMark::point;
  EXPECT_EQ(read("a;b\n1,234;1.234\n", o).at("a"), std::vector<double>{1234.0});
  EXPECT_TRUE(std::isnan(read("a;b\n0,5;1.234\n2;3\n", o).at("a")[0]));
  // Where commas separate, a point is the decimal one.
  EXPECT_EQ(read("a,b\n1.234,2.345\n").at("a"), std::vector<double>{1.234});
  // Several groups are sure, and then so are single ones.
  EXPECT_EQ(read("a;b\n1,234,567;1,234\n").at("b"), std::vector<double>{1234.0});
  EXPECT_EQ(read("a;b\n1.234.567;1,234\n").at("b"), std::vector<double>{1.234});
}

TEST(Csv, CommasForTwoThingsAreRefused) {
  expect_refused("CMOD,Kraft\n0,000,0,000\n0,004,1,068\n",
                 {"x.csv:2: 4 cells", "(line 1) has 2", "if the decimal mark is a comma"});
  expect_refused("CMOD\n0,004\n0,008\n", {"x.csv:2: 2 cells", "(line 1) has 1"});
}

TEST(Csv, LinesOfUnequalLengthAreRefused) {
  expect_refused("a,b\n1\n", {"x.csv:2: 1 cell", "(line 1) has 2"});
  expect_refused("a,b\n1,2\n1,2,3\n4,5\n", {"x.csv:3: 3 cells, the other rows have 2"});
  expect_refused("a,b,c\n1,2,3\n4,5,6\n7,8\n", {"x.csv:4: 2 cells, the other rows have 3", "not whole"});
  expect_refused("Remark\n1,2\n3,4\n", {"x.csv:2: 2 cells", "(line 1) has 1", "\"skip_rows\": 1"});
}

TEST(Csv, TablesWithoutNumbersAreRefused) {
  expect_refused("", {"no rows"});
  expect_refused("\n\n", {"no rows"});
  expect_refused("a,b\n", {"no rows"});
  expect_refused("one line of prose\nand another one\n", {"no rows"});
}

TEST(Csv, TwoTablesInOneFileAreRefusedUnlessOneIsMeant) {
  const std::string two = "a;b\n1;2\n3;4\n\nc;d\n5;6\n7;8\n";
  expect_refused(two, {"x.csv:5: another line of column names", "\"skip_rows\"", "\"rows\""});
  CsvOptions second;
  second.skip_rows = 4;
  EXPECT_EQ(read(two, second).at("c"), (std::vector<double>{5, 7}));
  CsvOptions first;
  first.rows = 2;
  EXPECT_EQ(read(two, first).at("b"), (std::vector<double>{2, 4}));
}

TEST(Csv, ColumnsOfTheSameNameAreRefusedWhenMeant) {
  const Table t = read("CMOD,Kraft,Kraft\n1,2,3\n");
  EXPECT_EQ(t.at("CMOD"), std::vector<double>{1.0});
  EXPECT_THROW((void)t.at("Kraft"), InputError);
  EXPECT_EQ(t.columns[2], std::vector<double>{3.0});
}

TEST(Csv, UnknownColumnsAreNamedWithTheLikelyOne) {
  const Table t = read("Kanal 1 CMOD;Kanal 1 Kraft\n1;2\n");
  EXPECT_NE(t.no_column("CMOD").find("did you mean \"Kanal 1 CMOD\"?"), std::string::npos) << t.no_column("CMOD");
  const Table bare = read("1;2\n3;4\n");
  EXPECT_EQ(bare.rows(), 2U);
  EXPECT_NE(bare.no_column("CMOD").find("no line names the columns; give a number, 1 to 2"), std::string::npos);
}

TEST(Csv, OptionsAreObeyed) {
  CsvOptions o;
  o.separator = CsvSeparator::semicolon;
  EXPECT_EQ(read("x\n1,5\n2,5\n", o).at("x"), (std::vector<double>{1.5, 2.5}));
  o = {};
  o.skip_rows = 2;
  EXPECT_EQ(read("Depth,mm\n100,75\nx,2020\nm,N\n1,2\n3,4\n", o).at("2020"), (std::vector<double>{2, 4}));
  o.skip_rows = 1;
  const Table bare = read("Remark\n1,2\n3,4\n", o);
  EXPECT_EQ(bare.columns[1], (std::vector<double>{2, 4}));
}

TEST(Csv, EncodingsThatAreNoneAreRefused) {
  expect_refused("\xFF\xFE" + in_utf16(plain, false) + "x", {"odd number of bytes"});
  expect_refused("PK\x03\x04\0\0\0\0\x08\0\0\0!\0"s, {"zero bytes", "workbook"});
  expect_refused("\xFF\xFE\0\0a\0\0\0"s, {"UTF-32"});
  CsvOptions o;
  o.encoding = TextEncoding::utf8;
  expect_refused("Kraft \xB5,b\n1,2\n", {"is no UTF-8 at byte 7", "windows-1252"}, o);
  EXPECT_EQ(read("Kraft \xB5,b\n1,2\n").names[0], "Kraft µ");
}

TEST(Csv, EveryDoubleSurvives) {
  std::string text = "x,y\n";
  std::vector<double> written;
  double x = 1.0 / 3.0;
  for (int k = 0; k < 200; ++k) {
    written.push_back(x);
    text += exact(x) + ",0.5\n";
    x *= k % 2 == 0 ? -7.3e-3 : 1.9e2;
  }
  EXPECT_EQ(read(text).at("x"), written);
}

TEST(DecimalNumber, OnlyGroupsOfThreeAreGroups) {
  for (const char* cell :
       {"1,23,456", "12,34", "1234,567.8", "0,123.4", "1.2.3", "1,234,", "1''234", "--1", "1e", "e5", ".", "1 23"}) {
    EXPECT_FALSE(to_number(cell, DecimalMark::point, true)) << cell;
  }
  EXPECT_EQ(to_number("1,234", DecimalMark::point, true), 1234.0);
  EXPECT_EQ(to_number("-1 234 567,25", DecimalMark::comma, true), -1234567.25);
  EXPECT_EQ(to_number(",5", DecimalMark::comma, true), 0.5);
  EXPECT_EQ(to_number("1e999", DecimalMark::point, true), std::nullopt);
}

}  // namespace
}  // namespace fpz::io
