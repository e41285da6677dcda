#include "base/table_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "base/csv_table.h"
#include "tests/temporary_folder.h"

namespace reachlab {
namespace {

std::string csvOf(const std::string& cell) {
  TableText table(',', "");
  table.cell(cell);
  return table.text();
}

TEST(TableText, QuotesInCsvWhatNeedsIt) {
  EXPECT_EQ(csvOf("plain text"), "plain text");
  EXPECT_EQ(csvOf("a,b"), "\"a,b\"");
  EXPECT_EQ(csvOf("say \"x\""), "\"say \"\"x\"\"\"");
  EXPECT_EQ(csvOf("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(csvOf("two\rlines"), "\"two\rlines\"");
}

TEST(TableText, GuardsInCsvWhatASpreadsheetWouldCarryOut) {
  for (const char* formula : {"=1+1", "+cmd", "-x", "@sum", "\tx", "\rx"}) {
    EXPECT_EQ(csvOf(formula), std::string("\"'") + formula + "\"");
  }
  EXPECT_EQ(csvOf("-1.5"), "-1.5") << "a number is none";
  EXPECT_EQ(csvOf("-1.5x"), "\"'-1.5x\"");
  EXPECT_EQ(csvOf("-"), "\"'-\"");
  EXPECT_EQ(csvOf("a=b"), "a=b");
}

TEST(TableText, ReadsInCsvWhatItWrote) {
  const std::vector<std::string> words{"a,b", "say \"x\"", "two\nlines", " beside ", "\"", "plain"};
  TableText table(',', "");
  table.row({"1", "2", "3", "4", "5", "6"});
  for (int i = 0; i < 2; ++i) table.row(words);
  const TemporaryFolder folder;
  std::ofstream(folder / "table.csv") << table.text() << "\r\n  a , \"b\" ,c,d,e,\r\n";
  const CsvTable read = readCsvTable(folder / "table.csv");
  ASSERT_EQ(read.rows.size(), 3u);
  EXPECT_EQ(read.rows[0].cells[0], "a,b");
  EXPECT_EQ(read.rows[1].cells[1], "say \"x\"");
  EXPECT_EQ(read.rows[1].cells[2], "two\nlines");
  EXPECT_EQ(read.rows[1].cells[4], "\"");
  EXPECT_EQ(read.rows[1].line, 4) << "a cell of the row before has a line break";
  EXPECT_EQ(read.rows[2].cells, (std::vector<std::string>{"a", "b", "c", "d", "e", ""}));
}

TEST(TableText, PutsItsCellsInRows) {
  TableText table('\t', "n/a");
  table.cell("a").number(0.1).whole(-7).missing().cell("");
  table.endRow();
  table.row({"x\ty", "u\nv\rw", "=1,\"2\""});
  table.number(std::numeric_limits<double>::infinity()).number(2);
  EXPECT_EQ(table.text(), "a\t0.1\t-7\tn/a\tn/a\nx y\tu v w\t=1,\"2\"\nn/a\t2");
  EXPECT_EQ(table.takeText(), "a\t0.1\t-7\tn/a\tn/a\nx y\tu v w\t=1,\"2\"\nn/a\t2");
  EXPECT_EQ(table.text(), "");
}

TEST(TableText, NumbersReadBackEqual) {
  const double third = 1.0 / 3;
  TableText csv(',', ""), tsv('\t', "n/a");
  csv.number(third).number(0.1).number(std::nan(""));
  tsv.number(third).number(0.1).number(1e300);
  EXPECT_EQ(csv.text(), "0.33333333333333331,0.10000000000000001,") << "17 digits";
  EXPECT_EQ(tsv.text(), "0.3333333333333333\t0.1\t1e+300") << "the shortest";
}

TEST(TsvTable, IsReadRowByRow) {
  const TsvTable table = parseTsv("a\tb\tc\r\n1\t2\t3\n\n4\n5\t6\t7\t8\n\t\t");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(table.rows, (std::vector<std::vector<std::string>>{{"1", "2", "3"}, {"4", "n/a", "n/a"}, {"5", "6", "7"}, {"", "", ""}}));
  EXPECT_EQ(toText(table), "a\tb\tc\n1\t2\t3\n4\tn/a\tn/a\n5\t6\t7\nn/a\tn/a\tn/a\n");
  EXPECT_TRUE(parseTsv("").columns.empty());
  EXPECT_TRUE(parseTsv("only\n").rows.empty());
  EXPECT_EQ(parseTsv("only\nx").rows, (std::vector<std::vector<std::string>>{{"x"}}));
}

// As other programs write them. Lines that end with a carriage return alone were a single header, and so a table without rows.
TEST(TsvTable, IsTheSameWhateverItsLinesEndWithAndWithAByteOrderMark) {
  for (const char* text : {"a\tb\n1\t2\n", "a\tb\r\n1\t2\r\n", "a\tb\r1\t2\r",
                           "\xef\xbb\xbf"
                           "a\tb\n1\t2"})
    EXPECT_EQ(toText(parseTsv(text)), "a\tb\n1\t2\n") << text;
}

}  // namespace
}  // namespace reachlab
