#include "devices/replay/reach_source.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/c3d_file.h"
#include "base/fault.h"
#include "tests/in_a_folder.h"
#include "tests/refusal.h"

namespace reachlab::devices {
namespace {

class OthersFiles : public InAFolder {
 protected:
  std::string write(const std::string& name, const std::string& text) const { return folder_.write(name, text); }
};

std::vector<RecordedReach> readFrom(const std::string& argument) { return readReaches(reachSourceOf(argument)); }

std::string refusalToReplay(const std::string& argument) {
  return refusalOf([&] { (void)readFrom(argument); });
}

// Two rows at 0 and 0.5 s, from (1, 2, 3) m to (4, 5, 6) m, as others write them.
void expectTwoRows(const RecordedReach& reach) {
  ASSERT_EQ(reach.time.size(), 2u) << reach.file;
  EXPECT_EQ(reach.time[1] - reach.time[0], 0.5) << reach.file;
  EXPECT_NEAR(norm(reach.position[0] - Vec3{1, 2, 3}), 0, 1e-15) << reach.file << ": a product with 0.001 is rounded";
  EXPECT_NEAR(norm(reach.position[1] - Vec3{4, 5, 6}), 0, 1e-15) << reach.file;
}

TEST_F(OthersFiles, ColumnsSayTheirUnit) {
  expectTwoRows(readFrom(write("si.csv", "time_s,x_m,y_m,z_m\n0,1,2,3\n0.5,4,5,6\n")).front());
  expectTwoRows(readFrom(write("mm.csv", "time_ms,x_mm,y_mm,z_mm\n0,1000,2000,3000\n500,4000,5000,6000\n")).front());
  expectTwoRows(readFrom(write("cm.csv", "z_cm;frame;y_cm;x_cm;time_s\n300;1;200;100;7\n600;2;500;400;7.5\n")).front());
}

TEST_F(OthersFiles, ColumnsAreNamed) {
  const std::string file = write("optotrak.csv", "Time (ms)\tHandX\tHandY\tHandZ\n0\t1000\t2000\t3000\n500\t4000\t5000\t6000\n");
  expectTwoRows(readFrom(file + ",time=Time (ms),time_unit=ms,x=HandX,y=HandY,z=HandZ,unit=mm").front());
  const std::string untimed = write("rate.csv", "X,Y,Z\n1,2,3\n4,5,6\n");
  expectTwoRows(readFrom(untimed + ",rate=2,x=X,y=Y,z=Z,unit=m").front());
  const RecordedReach plane = readFrom(untimed + ",rate=2,x=X,y=Y,unit=m").front();
  EXPECT_EQ(plane.position[1].z, 0) << "the hand moved in a plane";
}

TEST_F(OthersFiles, APathMayHoldCommas) { expectTwoRows(readFrom(write("a,b.csv", "time_s,x_m,y_m,z_m\n0,1,2,3\n0.5,4,5,6\n")).front()); }

TEST_F(OthersFiles, WhatIsWrongWithATableIsSaid) {
  const std::string file = write("t.csv", "T,X,Y,Z\n0,1,2,3\n0.5,4,5,6\n");
  EXPECT_TRUE(holds(refusalToReplay(file), "t.csv:1: time_s: column is missing"));
  EXPECT_TRUE(holds(refusalToReplay(file + ",time=T,x=X,y=Y,z=Z"), "t.csv:1: T: the unit of time is not told; allowed: s, ms"));
  EXPECT_TRUE(holds(refusalToReplay(file + ",time=T,time_unit=s,x=X,y=Y,z=Z"), "X: the unit of length is not told; allowed: m, cm, mm"));
  EXPECT_TRUE(holds(refusalToReplay(file + ",time=T,time_unit=s,x=A,y=Y,z=Z,unit=m"), "A: column is missing; allowed: T, X, Y, Z"));
  EXPECT_TRUE(holds(refusalToReplay(file + ",unit=inch"), "unit=inch"));
  EXPECT_TRUE(holds(refusalToReplay(file + ",colour=red"), "colour is not known"));
  EXPECT_TRUE(holds(refusalToReplay(file + ",rate=0"), "rate=0"));
  EXPECT_TRUE(holds(refusalToReplay(write("inch.csv", "time_s,x_in,y_in,z_in\n0,1,2,3\n")), "x_m: column is missing"));
  EXPECT_TRUE(holds(refusalToReplay(write("comma.csv", "time_s;x_m;y_m;z_m\n0;1,5;2;3\n")), "comma.csv:2: x_m: '1,5' is not a number"));
}

struct Bids {
  std::string channels =
      "name\tcomponent\ttype\ttracked_point\tunits\n"
      "hx\tx\tPOS\thand\tmm\nhy\ty\tPOS\thand\tmm\nhz\tz\tPOS\thand\tmm\n"
      "ex\tx\tPOS\telbow\tm\ney\ty\tPOS\telbow\tm\nez\tz\tPOS\telbow\tm\n";
  std::string motion = "1000\t2000\t3000\t1\t2\t3\n4000\t5000\t6000\t4\t5\t6\n";
  std::string json = R"({"SamplingFrequency": 2})";
  std::string events;
};

std::string writeBids(const TemporaryFolder& folder, const Bids& bids) {
  const auto put = [&](const std::string& name, const std::string& text) {
    std::filesystem::remove(folder / name);
    if (!text.empty()) std::ofstream(folder / name) << text;
  };
  const std::string base = "sub-A_task-reach_tracksys-omc_run-1";
  put(base + "_motion.tsv", bids.motion);
  put(base + "_motion.json", bids.json);
  put(base + "_channels.tsv", bids.channels);
  put("sub-A_task-reach_run-1_events.tsv", bids.events);
  return (folder / (base + "_motion.tsv")).string();
}

// A key that no file uses, and a rate beside times, would otherwise change nothing or throw the times away.
TEST_F(OthersFiles, KeysThatDoNotFitTheFileAreRefused) {
  const std::string table = write("t.csv", "time_s,x_m,y_m,z_m\n0,1,2,3\n0.5,4,5,6\n");
  EXPECT_TRUE(holds(refusalToReplay(table + ",rate=50"), "t.csv:1: time_s: is there beside rate="));
  EXPECT_TRUE(holds(refusalToReplay(table + ",point=hand"),
                    "point is not known for " + table + "; allowed: time, x, y, z, time_unit, unit or rate"));
  EXPECT_TRUE(holds(refusalToReplay(table + ",trial_type=go"), "trial_type is not known for"));
  Bids bids;
  bids.channels += "t\tn/a\tLATENCY\tn/a\ts\n";
  bids.motion = "1\t2\t3\t1\t2\t3\t0\n4\t5\t6\t4\t5\t6\t0.5\n";
  const std::string latency = writeBids(folder_, bids);
  EXPECT_EQ(refusalToReplay(latency + ",point=hand"), "");
  EXPECT_TRUE(holds(refusalToReplay(latency + ",point=hand,rate=4"), "has a LATENCY channel beside rate="));
  EXPECT_TRUE(holds(refusalToReplay(latency + ",point=hand,x=X"), "x is not known for"));
  EXPECT_EQ(refusalToReplay(folder_.path() + ",point=hand"), "") << "the folder has a file that uses it";
}

TEST_F(OthersFiles, ABidsPointIsReadWithItsUnits) {
  expectTwoRows(readFrom(writeBids(folder_, {}) + ",point=hand").front());
  expectTwoRows(readFrom(writeBids(folder_, {}) + ",point=elbow").front());
}

TEST_F(OthersFiles, EachBidsEventThatLastsIsAReach) {
  Bids bids;
  bids.json = R"({"SamplingFrequency": 20})";
  bids.motion.clear();
  for (int i = 0; i < 100; ++i) bids.motion += (i == 31 ? "n/a" : std::to_string(10 * i)) + "\t0\t0\t0\t0\t0\n";
  bids.events = "onset\tduration\ttrial_type\n0.5\t1\treach\n1.6\t0\tbeep\n2\t0.5\tcatch\n3\t1.5\treach\n4\tn/a\treach\n";
  const std::string file = writeBids(folder_, bids);
  EXPECT_EQ(readFrom(file + ",point=hand").size(), 3u);
  Bids own = bids;  // our own recordings have a column more
  own.events = "onset\tduration\ttrial_type\tmovement_time\n0.5\t1\treach\t0.8\n2\t0.5\tcatch\t0.1\n3\t1.5\treach\tn/a\n";
  for (const char* type : {"", ",trial_type=reach"})
    EXPECT_EQ(readFrom(writeBids(folder_, own) + ",point=hand" + type).size(), 1u)
        << "where the hand was to stay, or never moved, is no reach";
  writeBids(folder_, bids);
  const std::vector<RecordedReach> reaches = readFrom(file + ",point=hand,trial_type=reach");
  ASSERT_EQ(reaches.size(), 2u);
  EXPECT_NEAR(reaches[0].time.front(), 0.5, 1e-12);
  EXPECT_NEAR(reaches[1].time.back(), 4.5, 1e-12);
  EXPECT_NEAR(reaches[1].position.front().x, 0.6, 1e-12) << "row 60, in mm";
  EXPECT_TRUE(holds(refusalToReplay(file + ",point=hand,trial_type=point"), "no event of trial_type point that lasts"));
}

TEST_F(OthersFiles, WhatIsWrongWithBidsIsSaid) {
  const auto refusal = [&](Bids bids, const std::string& options = ",point=hand") {
    return refusalToReplay(writeBids(folder_, bids) + options);
  };
  EXPECT_EQ(refusal({}), "");
  EXPECT_TRUE(holds(refusal({}, ""), "has 2 tracked points, and none is named; allowed: point= with one of hand, elbow"));
  EXPECT_TRUE(holds(refusal({}, ",point=foot"), "has no x, y and z of type POS for the point foot"));
  Bids bids;
  bids.channels.clear();
  EXPECT_TRUE(holds(refusal(bids), "_channels.tsv: is missing"));
  bids = {};
  bids.json.clear();
  EXPECT_TRUE(holds(refusal(bids), "_motion.json: is missing, and there is no LATENCY channel"));
  bids.json = "{";
  EXPECT_TRUE(holds(refusal(bids), "SamplingFrequency: is missing or no number"));
  bids = {};
  bids.motion = "hx\thy\thz\tex\tey\tez\n" + bids.motion;
  EXPECT_TRUE(holds(refusal(bids), "_motion.tsv:1: column 1: 'hx' is not a number; allowed: a number or n/a (motion.tsv has no header)"));
  bids.motion = "1\t2\t3\n";
  EXPECT_TRUE(holds(refusal(bids), "_motion.tsv:1: has 3 cells; allowed: 6, as its channels"));
  bids = {};
  bids.channels.replace(bids.channels.find("\tmm"), 3, "\tinch");
  EXPECT_TRUE(holds(refusal(bids), "_channels.tsv:2: the unit of length is 'inch'; allowed: m, cm, mm"));
  bids = {};
  bids.motion = "n/a\tn/a\tn/a\t0\t0\t0\n" + std::string("n/a\t0\t0\t0\t0\t0\n");
  EXPECT_TRUE(holds(refusal(bids), "the point is never seen"));
}

// Without the places of its points, each of which is seen in every frame.
C3dFile c3dOf(const std::vector<C3dLabel>& points, std::size_t frames, const std::string& unit, double rate = 100) {
  C3dFile c3d;
  c3d.rate = rate;
  c3d.pointUnit = unit;
  c3d.points = points;
  c3d.frames = frames;
  c3d.seen.assign(frames * points.size(), 1);
  return c3d;
}

TEST_F(OthersFiles, AC3dPointIsReadAndAGapIsRefused) {
  C3dFile c3d = c3dOf({{"WRIST"}, {"INDEX"}}, 60, "mm");
  for (std::size_t i = 0; i < 120; ++i)
    for (const float value : {static_cast<float>(i), 2.0f, 3.0f}) c3d.places.push_back(value);
  c3d.seen[1] = c3d.seen[2 * 20 + 1] = 0;  // the first frame, and one inside
  const std::string file = write("reach.c3d", c3dBytes(c3d));
  const RecordedReach reach = readFrom(file + ",point=INDEX").front();
  ASSERT_EQ(reach.time.size(), 58u);
  EXPECT_EQ(reach.time.front(), 0.01);
  EXPECT_NEAR(reach.position.front().x, 0.003, 1e-9) << "single precision";
  EXPECT_TRUE(holds(refusalToReplay(file), "has 2 points, and none is named; allowed: point= with one of WRIST, INDEX"));
  EXPECT_TRUE(holds(refusalToReplay(file + ",point=NOSE"), "has no point NOSE; allowed: point= with one of WRIST, INDEX"));
  for (std::size_t frame = 20; frame < 40; ++frame) c3d.seen[2 * frame + 1] = 0;
  EXPECT_TRUE(holds(refusalToReplay(write("gap.c3d", c3dBytes(c3d)) + ",point=INDEX"),
                    "not seen for 0.210 s from 0.190 s; allowed: gaps of up to 0.1 s"));
  c3d.pointUnit = "furlong";
  EXPECT_TRUE(holds(refusalToReplay(write("unit.c3d", c3dBytes(c3d)) + ",point=WRIST"), "the unit of length is 'furlong'"));
  EXPECT_EQ(refusalToReplay(write("unit.c3d", c3dBytes(c3d)) + ",point=WRIST,unit=mm"), "");
  EXPECT_TRUE(holds(refusalToReplay(write("no.c3d", "hello")), "is no C3D file"));
}

// A trial's file begins before the movement and may end after it: what is replayed is the same as from the trial's BIDS files.
TEST_F(OthersFiles, AC3dReachIsCutByItsEvents) {
  C3dFile c3d = c3dOf({{"hand"}}, 60, "m");
  c3d.places.assign(180, 1);
  c3d.events = {{"go", 0.1}, {"onset", 0.17}, {"end", 0.43}};
  const RecordedReach reach = readFrom(write("cut.c3d", c3dBytes(c3d))).front();
  EXPECT_EQ(reach.time.front(), 0.17);
  EXPECT_EQ(reach.time.back(), 0.43);
  c3d.events = {{"go", 0.1}, {"end", 0.43}};
  EXPECT_TRUE(holds(refusalToReplay(write("stayed.c3d", c3dBytes(c3d))), "has no trial in which the hand was to move and did"));
  c3d.events.pop_back();
  EXPECT_EQ(readFrom(write("whole.c3d", c3dBytes(c3d))).front().time.size(), 60u);
}

TEST_F(OthersFiles, AFolderMayHoldAllKinds) {
  write("a.csv", "time_s,x_m,y_m,z_m\n0,1,2,3\n0.5,4,5,6\n");
  C3dFile c3d = c3dOf({{"hand"}}, 2, "m", 2);  // half a second apart is no gap at this rate
  c3d.places = {1, 2, 3, 4, 5, 6};
  write("b.c3d", c3dBytes(c3d));
  write("c.txt", "no reach");
  const std::vector<RecordedReach> reaches = readFrom(folder_.path());
  ASSERT_EQ(reaches.size(), 2u);
  EXPECT_TRUE(reaches[1].file.ends_with("b.c3d"));
}

TEST_F(OthersFiles, CellsMayBeQuotedAndSpacedAndColumnsMayComeInAnyUnit) {
  expectTwoRows(readFrom(write("q.csv", "\"time_s\" , \"x_m\",y_m,z_m\r\n \"0\",1, 2 ,3\r\n  \r\n0.5,4,5,\"6\"\r\n")).front());
  expectTwoRows(
      readFrom(write("named.csv", "clock_ms,hx_cm,hy_mm,hz_m\n0,100,2000,3\n500,400,5000,6\n") + ",time=clock_ms,x=hx_cm,y=hy_mm,z=hz_m")
          .front());
  expectTwoRows(readFrom(write("mixed.csv", "time_s,x_cm,y_mm,z_m\n0,100,2000,3\n0.5,400,5000,6\n")).front());
  const std::string spreadsheet = "\xef\xbb\xbfz_m, trial, time_s, x_m, y_m\r\n3, a, 0, 1, 2\r\n\r\n6, a, 0.5, 4, 5\r\n";
  expectTwoRows(readFrom(write("mark.csv", spreadsheet)).front());
  EXPECT_TRUE(holds(refusalToReplay(write("nan.csv", "time_s,x_m,y_m,z_m\n0,1,nan,3\n")), "nan.csv: the point is never seen"));
  EXPECT_TRUE(holds(refusalToReplay(write("inf.csv", "time_s,x_m,y_m,z_m\n0,1,inf,3\n")), "inf.csv:2: y_m: "));
  EXPECT_TRUE(holds(refusalToReplay(write("untimed.csv", "time_s,x_m,y_m,z_m\n,1,2,3\n")), "untimed.csv:2: time_s: "));
  EXPECT_TRUE(holds(refusalToReplay(write("more.csv", "time_s,x_m,y_m,z_m\n0,1,2,3,4\n")), "more.csv:2: has 5 cells"));
  EXPECT_TRUE(holds(refusalToReplay(write("end.csv", "time_s,x_m,y_m,z_m\n0,1,2,x\n")), "end.csv:2: z_m: 'x' is not a number"));
  EXPECT_TRUE(holds(refusalToReplay(write("few.csv", "time_s,x_m,y_m,z_m\n0,1,2\n")), "few.csv:2: has 3 cells; allowed: 4, as the header"));
  EXPECT_TRUE(holds(refusalToReplay(write("back.csv", "time_s,x_m,y_m,z_m\n0,1,2,3\n0,4,5,6\n")), "back.csv:3: time_s: does not increase"));
  EXPECT_TRUE(holds(refusalToReplay(write("none.csv", "time_s,x_m,y_m,z_m\n")), "none.csv: has no samples; allowed: at least one row"));
  EXPECT_TRUE(holds(refusalToReplay(write("wide.csv", "X,Y\n1,2\n3,4\n") + ",rate=2,x=X,unit=m"), "y_m: column is missing"))
      << "a plane has two named axes";
}

TEST_F(OthersFiles, RatesAreBounded) {
  const std::string file = write("rate.csv", "x_m,y_m,z_m\n1,2,3\n4,5,6\n");
  EXPECT_EQ(readFrom(file + ",rate=1").front().time, (std::vector<double>{0, 1}));
  EXPECT_EQ(readFrom(file + ",rate=1000000").front().time[1], 1e-6);
  for (const char* bad : {",rate=0.9", ",rate=1000001", ",time_unit=h", ",unit=km"}) EXPECT_THROW(readFrom(file + bad), FaultError) << bad;
  for (const char* good : {",unit=mm", ",unit=cm", ",time_unit=ms"}) EXPECT_EQ(refusalToReplay(file + ",rate=2" + good), "") << good;
}

TEST_F(OthersFiles, ABidsLatencyIsTheTimeSinceItsFirstRow) {
  Bids bids;
  bids.channels =
      "name\tcomponent\ttype\ttracked_point\tunits\nt\tn/a\tLATENCY\tn/a\ts\nhx\tx\tPOS\thand\tcm\nhy\ty\tPOS\thand\tmm\n"
      "hz\tz\tPOS\thand\tm\nhv\tx\tVEL\thand\tm\nq\tquat_w\tPOS\thand\tm\n";
  bids.motion = "10\t100\t2000\t3\t9\t9\r\nn/a\t0\t0\t0\t0\t0\n\n10.5\t400\t5000\t6\t9\t9\n";
  bids.json.clear();
  const RecordedReach reach = readFrom(writeBids(folder_, bids)).front();
  expectTwoRows(reach);
  EXPECT_EQ(reach.time.front(), 0);
  EXPECT_EQ(reach.file.substr(reach.file.size() - 11), "_motion.tsv");
  bids.motion = "0\t1\t1\t1\t0\t0\n0\t1\t1\t1\t0\t0\n";
  EXPECT_TRUE(holds(refusalToReplay(writeBids(folder_, bids)), "time does not increase at 0 s"));
}

TEST_F(OthersFiles, TheEffectiveRateGoesBeforeTheNominalOneAndTheAskedOneBeforeBoth) {
  Bids bids;
  bids.json = R"({"SamplingFrequency": 3, "SamplingFrequencyEffective": 2})";
  expectTwoRows(readFrom(writeBids(folder_, bids) + ",point=hand").front());
  bids.json = R"({"SamplingFrequency": 2, "SamplingFrequencyEffective": "n/a"})";
  expectTwoRows(readFrom(writeBids(folder_, bids) + ",point=hand").front());
  EXPECT_EQ(readFrom(writeBids(folder_, bids) + ",point=hand,rate=4").front().time[1], 0.25);
  bids.json = R"({"SamplingFrequency": 0})";
  EXPECT_TRUE(holds(refusalToReplay(writeBids(folder_, bids) + ",point=hand"), "SamplingFrequency: is missing or no number above 0"));
}

TEST_F(OthersFiles, AGapOfATenthOfASecondIsLeftToTheSpline) {
  for (const auto& [gap, isRead] : {std::pair{9, true}, {10, false}}) {
    Bids unseen;
    unseen.json = R"({"SamplingFrequency": 100})";
    unseen.motion.clear();
    std::string withoutRows = "time_s,x_m,y_m,z_m\n", withEmptyCells = withoutRows + "0,,,\n";
    for (int i = 0; i < 60; ++i) {
      const bool missing = i >= 20 && i < 20 + gap;
      const std::string time = fmt::format("{:.2f}", 1 + 0.01 * i);
      unseen.motion += (missing ? "n/a" : std::to_string(i)) + "\t0\t0\t0\t0\t0\n";
      withEmptyCells += time + (missing ? ",,0,0\n" : ",1,0,0\n");
      if (!missing) withoutRows += time + ",1,0,0\n";
    }
    for (const std::string& file :
         {writeBids(folder_, unseen) + ",point=hand", write("cells.csv", withEmptyCells), write("rows.csv", withoutRows)}) {
      const std::string said = refusalToReplay(file);
      EXPECT_EQ(said.empty(), isRead) << file << ", " << gap << ": " << said;
    }
  }
}

// An event's own rows and no others, the first and the last among them; without events the whole file.
TEST_F(OthersFiles, AnEventHoldsTheSamplesFromItsOnsetToItsEnd) {
  Bids bids;
  bids.json = R"({"SamplingFrequency": 4})";
  bids.motion.clear();
  for (int i = 0; i < 40; ++i) bids.motion += std::to_string(i) + "\t0\t0\t0\t0\t0\n";
  EXPECT_EQ(readFrom(writeBids(folder_, bids) + ",point=hand").front().time.size(), 40u);
  bids.events = "onset\tduration\n1.25\t2\n5\t0.5\n";
  const auto reaches = readFrom(writeBids(folder_, bids) + ",point=hand");
  ASSERT_EQ(reaches.size(), 2u);
  EXPECT_EQ(reaches[0].time.front(), 1.25);
  EXPECT_EQ(reaches[0].time.back(), 3.25);
  EXPECT_EQ(reaches[1].time, (std::vector<double>{5, 5.25, 5.5}));
  EXPECT_TRUE(reaches[1].file.ends_with("_motion.tsv: event 2")) << reaches[1].file;
  EXPECT_TRUE(holds(refusalToReplay(writeBids(folder_, bids) + ",point=hand,trial_type=reach"), "no event of trial_type reach"))
      << "a table without types has none of that type";
  bids.events = "onset\tduration\nsoon\t2\n";
  EXPECT_TRUE(holds(refusalToReplay(writeBids(folder_, bids) + ",point=hand"),
                    "_events.tsv:2: onset: 'soon' is not a number; allowed: a number or n/a"));
  bids.events = "onset\tduration\n1\tn/a\n1\t-1\n";
  EXPECT_TRUE(holds(refusalToReplay(writeBids(folder_, bids) + ",point=hand"), "has no event that lasts"));
}

TEST_F(OthersFiles, AC3dFileMayEndInCapitalsAndGiveItsPlacesPointByPoint) {
  C3dFile c3d = c3dOf({{"A"}, {"B"}}, 3, "cm", 50);
  for (const float value :
       {1.0f, 2.0f, 3.0f, 10.0f, 20.0f, 30.0f, 4.0f, 5.0f, 6.0f, 40.0f, 50.0f, 60.0f, 7.0f, 8.0f, 9.0f, 70.0f, 80.0f, 90.0f})
    c3d.places.push_back(value);
  write("UP.C3D", c3dBytes(c3d));
  const auto reach = readFrom(folder_.path() + ",point=B").front();
  EXPECT_EQ(reach.time, (std::vector<double>{0, 0.02, 0.04}));
  EXPECT_LT(norm(reach.position[1] - Vec3{0.4, 0.5, 0.6}), 1e-12);
  EXPECT_TRUE(holds(refusalToReplay((folder_ / "gone.c3d").string()), "gone.c3d: no such file or folder to replay"));
}

}  // namespace
}  // namespace reachlab::devices
