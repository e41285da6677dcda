#include "analysis/study/chunk.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "analysis/study/gzip.h"
#include "base/error.h"
#include "sim/record/log/whole_file.h"
#include "tests/in_a_folder.h"
#include "tests/refusal.h"
#include "tests/study/made_study.h"

namespace reachlab::study {
namespace {

ChunkRows someRows() {
  ChunkRows rows = chunkOf({{1, 2.5, -3}, {4, std::nan(""), 6e300}});
  rows.profiles = {0.5F, -1.5F, 3.25F};
  rows.csvGz = "a,b,c\n";
  return rows;
}

class Chunks : public InAFolder {};

TEST_F(Chunks, ReadsBackAsItWasWritten) {
  EXPECT_FALSE(isChunkThere(folder_.path(), 1234, 99));
  EXPECT_THROW(readChunk(folder_.path(), 1234, 99), ResourceError);
  writeChunk(folder_.path(), 1234, 99, someRows());
  EXPECT_EQ(chunkPath(folder_.path(), 1234), folder_.path() + "/chunks/001/00001234.chunk");
  EXPECT_TRUE(isChunkThere(folder_.path(), 1234, 99));
  const ChunkRows rows = readChunk(folder_.path(), 1234, 99);
  EXPECT_EQ(rows.rows, 2);
  EXPECT_EQ(rows.columns, 3u);
  ASSERT_EQ(rows.values.size(), 6u);
  EXPECT_EQ(rows.values[1], 4) << "column by column";
  EXPECT_TRUE(std::isnan(rows.values[3]));
  EXPECT_EQ(rows.values[5], 6e300);
  EXPECT_EQ(rows.profiles, (std::vector<float>{0.5F, -1.5F, 3.25F}));
  EXPECT_EQ(rows.csvGz, "a,b,c\n");
  ChunkRows plain = someRows();
  plain.profiles.clear();
  writeChunk(folder_.path(), 0, 99, plain);
  EXPECT_TRUE(readChunk(folder_.path(), 0, 99).profiles.empty());
}

TEST_F(Chunks, OfAnotherStudyOrPlaceIsRefused) {
  writeChunk(folder_.path(), 3, 99, someRows());
  EXPECT_THROW(isChunkThere(folder_.path(), 3, 98), ResourceError);
  std::filesystem::copy_file(chunkPath(folder_.path(), 3), chunkPath(folder_.path(), 4));
  EXPECT_THROW(isChunkThere(folder_.path(), 4, 99), ResourceError);
}

// Whatever byte of it is not what it was, and wherever it ends.
TEST_F(Chunks, ThatIsDamagedIsToldWithTheRemedy) {
  writeChunk(folder_.path(), 3, 99, someRows());
  const std::string path = chunkPath(folder_.path(), 3), whole = record::readWholeFile(path);
  const auto refusalOf = [&](const std::string& bytes) -> std::string {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
    return reachlab::refusalOf([&] { readChunk(folder_.path(), 3, 99); });
  };
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string other = whole;
    other[at] = static_cast<char>(other[at] ^ 0x10);
    EXPECT_NE(refusalOf(other), "") << at;
  }
  for (const std::size_t length : {std::size_t{0}, std::size_t{71}, std::size_t{72}, whole.size() - 1})
    EXPECT_TRUE(holds(refusalOf(whole.substr(0, length)), "is damaged; delete it, and resume the study")) << length;
  EXPECT_TRUE(holds(refusalOf(whole + "x"), "is damaged"));
  std::string more = whole;
  more[24] = 3;
  EXPECT_NE(refusalOf(more).find("is damaged"), std::string::npos) << "more rows than there are";
  EXPECT_EQ(refusalOf(whole), "");
}

TEST(Fingerprint, ChangesWithWhateverChangesATable) {
  Design d;
  d.text = "t", d.name = "n", d.planText = "p", d.experimentTexts = {{"a", "x"}};
  std::vector<std::uint64_t> prints{fingerprintOf(d), fingerprintOf(d)};
  EXPECT_EQ(prints[0], prints[1]);
  prints.pop_back();
  for (std::string Design::*member : {&Design::text, &Design::name, &Design::planText}) {
    Design other = d;
    other.*member += "!";
    prints.push_back(fingerprintOf(other));
  }
  for (const std::map<std::string, std::string>& texts :
       {std::map<std::string, std::string>{{"a", "y"}}, {{"b", "x"}}, {{"a", "x"}, {"c", ""}}}) {
    Design other = d;
    other.experimentTexts = texts;
    prints.push_back(fingerprintOf(other));
  }
  std::sort(prints.begin(), prints.end());
  EXPECT_EQ(std::unique(prints.begin(), prints.end()), prints.end());
}

TEST(Gzip, OfManyMembersIsTheirTextsOneBehindTheOther) {
  std::string large;
  for (int i = 0; i < 40000; ++i) large += std::to_string(i * 7919 % 10007) + ",";
  const std::string bytes = gzipMember("first\n") + gzipMember("") + gzipMember(large);
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/x.gz";
  std::ofstream(path, std::ios::binary) << bytes;
  const gzFile file = gzopen(path.c_str(), "rb");
  ASSERT_NE(file, nullptr);
  std::string text(large.size() + 100, '\0');
  const int read = gzread(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  text.resize(static_cast<std::size_t>(std::max(0, read)));
  EXPECT_EQ(text, "first\n" + large);
  EXPECT_EQ(gzipMember(large), gzipMember(large)) << "no time, no name";
  EXPECT_EQ(gzipMember("a").substr(0, 2), "\x1f\x8b");
  EXPECT_LT(gzipMember(large).size(), large.size() / 2);
}

}  // namespace
}  // namespace reachlab::study
