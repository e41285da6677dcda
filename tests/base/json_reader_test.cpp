#include "base/json/json_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/refusal.h"

namespace reachlab {
namespace {

using Use = std::function<void(ObjectReader&)>;

/// The faults, a line each, that reading the text as `use` does tells.
std::string toldOf(const std::string& text, const Use& use, const std::string& path = "") {
  const JsonNode root = parseJson(text, "f");
  FaultList faults("f");
  ObjectReader reader(faults, root, path);
  use(reader);
  return toText(faults.faults());
}

// A member of each kind, all of which are 7 until they are read.
struct Values {
  double number = 7;
  int whole = 7;
  bool truth = false;
  std::string text = "7", choice = "7";
  std::vector<double> numbers{7};
  std::vector<std::string> strings{"7"};
  std::vector<bool> took;  // what the readers that say so say of themselves

  std::string read(const std::string& json, bool required = false) {
    return toldOf(json, [&](ObjectReader& reader) {
      if (required) took.push_back(reader.requiredNumber("n", positive("kg"), number));
      else reader.number("n", positive("kg"), number);
      reader.integer("i", 2, 9, whole);
      reader.boolean("t", truth);
      reader.text("s", text);
      took.push_back(reader.choice("c", {"a", "b"}, choice, required));
      if (const JsonNode* list = reader.optional("l")) took.push_back(reader.numbers(*list, "l", -1, anyNumber(), numbers));
      if (const JsonNode* list = reader.optional("w")) took.push_back(reader.strings(*list, "w", 3, strings));
      reader.finish();
    });
  }
  void expectUnread() const {
    EXPECT_TRUE(whole == 7 && !truth && text == "7" && choice == "7");
    EXPECT_EQ(numbers, std::vector<double>{7});
    EXPECT_EQ(strings, std::vector<std::string>{"7"});
  }
};

TEST(ObjectReader, ReadsEachKindOfValue) {
  for (const bool required : {false, true}) {
    Values v;
    EXPECT_EQ(v.read(R"({"n": 1.5, "i": 9, "t": true, "s": "x y", "c": "b", "l": [1, -2], "w": ["p", "q", "r"]})", required), "");
    EXPECT_EQ(v.took, std::vector<bool>(required ? 4 : 3, true));
    EXPECT_EQ(v.number, 1.5);
    EXPECT_EQ(v.whole, 9);
    EXPECT_TRUE(v.truth);
    EXPECT_EQ(v.text, "x y");
    EXPECT_EQ(v.choice, "b");
    EXPECT_EQ(v.numbers, (std::vector<double>{1, -2}));
    EXPECT_EQ(v.strings, (std::vector<std::string>{"p", "q", "r"}));
    EXPECT_EQ(v.read(R"({"i": 2})"), "") << "either bound is allowed";
    EXPECT_EQ(v.whole, 2);
  }
}

TEST(ObjectReader, LeavesWhatIsNotThere) {
  Values v;
  EXPECT_EQ(v.read("{}"), "");
  EXPECT_EQ(v.took, std::vector<bool>{false});
  EXPECT_EQ(v.number, 7);
  v.expectUnread();
}

TEST(ObjectReader, TellsWhatIsMissing) {
  double number = 7;
  std::string choice = "7";
  EXPECT_EQ(toldOf(
                "\n {}",
                [&](ObjectReader& reader) {
                  EXPECT_EQ(reader.required("o", "an object"), nullptr);
                  EXPECT_FALSE(reader.requiredNumber("n", positive("kg"), number));
                  EXPECT_FALSE(reader.choice("c", {"a", "b"}, choice, true));
                },
                "in"),
            "f:2:2: in.o: is missing; allowed: an object\nf:2:2: in.n: is missing; allowed: more than 0 kg\n"
            "f:2:2: in.c: is missing; allowed: a or b");
  EXPECT_TRUE(std::isnan(number)) << "so that the value's own check says what is allowed";
}

TEST(ObjectReader, TellsWhatIsOfAnotherKind) {
  Values v;
  EXPECT_EQ(v.read(R"({"n": "1", "i": null, "t": 1, "s": true, "c": [], "l": {}, "w": 2})"),
            "f:1:7: n: is a string; allowed: more than 0 kg\nf:1:17: i: is null; allowed: a whole number from 2 to 9\n"
            "f:1:28: t: is a number; allowed: true or false\nf:1:36: s: is a truth value; allowed: a string\n"
            "f:1:47: c: is an array; allowed: a or b\nf:1:56: l: is an object; allowed: an array of numbers\n"
            "f:1:65: w: is a number; allowed: an array of 3 strings");
  EXPECT_EQ(v.took, std::vector<bool>(3, false));
  EXPECT_TRUE(std::isnan(v.number));
  v.expectUnread();
  EXPECT_EQ(toldOf("[]", [](ObjectReader& reader) { EXPECT_EQ(reader.required("x", "y"), nullptr); }),
            "f:1:1: file: is an array; allowed: an object { … }");
  EXPECT_EQ(toldOf(
                "3", [](ObjectReader&) {}, "in"),
            "f:1:1: in: is a number; allowed: an object { … }");
}

TEST(ObjectReader, TellsWhatIsOutOfRange) {
  Values v;
  EXPECT_EQ(v.read(R"({"n": 0, "i": 1, "c": "x"})"),
            "f:1:7: n: is 0; allowed: more than 0 kg\nf:1:15: i: is 1; allowed: a whole number from 2 to 9\n"
            "f:1:23: c: is \"x\"; allowed: a or b");
  EXPECT_EQ(v.took, std::vector<bool>{false});
  EXPECT_TRUE(std::isnan(v.number));
  v.expectUnread();
}

TEST(ObjectReader, TellsAListOfTheWrongLengthAndEachWrongElement) {
  const auto numbers = [](const std::string& list, int length) {
    std::vector<double> values{7};
    std::string told = toldOf("{\"l\": " + list + "}", [&](ObjectReader& reader) {
      (void)reader.numbers(*reader.optional("l"), "l", length, positive("kg"), values);
    });
    EXPECT_EQ(values == std::vector<double>{7}, !told.empty()) << list << ": a faulty list is not taken over in part";
    return told;
  };
  EXPECT_EQ(numbers("[1, 2, 3]", -1), "");
  EXPECT_EQ(numbers("[]", 0), "");
  EXPECT_EQ(numbers("[1]", 2), "f:1:7: l: has 1 element; allowed: an array of 2 numbers");
  EXPECT_EQ(numbers("[1, 2]", 1), "f:1:7: l: has 2 elements; allowed: an array of 1 number");
  EXPECT_EQ(numbers("[1]", 0), "f:1:7: l: has 1 element; allowed: an array of 0 numbers");
  EXPECT_EQ(numbers("[1, -2, \"3\"]", 3),
            "f:1:11: l[1]: is -2; allowed: more than 0 kg\nf:1:15: l[2]: is a string; allowed: more than 0 kg");
  const auto strings = [](const std::string& list) {
    std::vector<std::string> values;
    return toldOf("{\"l\": " + list + "}", [&](ObjectReader& reader) { (void)reader.strings(*reader.optional("l"), "l", 2, values); });
  };
  EXPECT_EQ(strings("[\"a\"]"), "f:1:7: l: has 1 elements; allowed: an array of 2 strings");
  EXPECT_EQ(strings("[\"a\", 1]"), "f:1:13: l[1]: is a number; allowed: a string");
}

TEST(ObjectReader, TellsWhatWasNotAskedForWithTheNearestName) {
  EXPECT_EQ(toldOf(
                "{\"mass\": 1,\n \"lenght\": 2, \"zzzzzz\": 3}",
                [](ObjectReader& reader) {
                  for (const char* key : {"mass", "length", "height", "mass"}) (void)reader.optional(key);
                  reader.finish();
                },
                "in"),
            "f:2:2: in.lenght: is not known here; did you mean length?; allowed: height, length or mass\n"
            "f:2:15: in.zzzzzz: is not known here; allowed: height, length or mass");
}

std::vector<Fault> thrownBy(const FaultList& faults) {
  return faultsToldBy([&] { faults.throwIfAny(); });
}

TEST(FaultList, ThrowsItsFaultsInTheOrderOfTheFile) {
  FaultList faults("f");
  EXPECT_TRUE(faults.empty());
  EXPECT_NO_THROW(faults.throwIfAny());
  const auto at = [](int line, int column) {
    JsonNode node;
    node.line = line, node.column = column;
    return node;
  };
  faults.add(at(2, 5), "c", "is 3");
  faults.add(at(2, 1), "b", "is 2");
  faults.add(at(1, 9), "a", "is 1");
  faults.add(at(2, 5), "d", "is 4");
  EXPECT_FALSE(faults.empty());
  EXPECT_EQ(toText(thrownBy(faults)), "f:1:9: a: is 1\nf:2:1: b: is 2\nf:2:5: c: is 3\nf:2:5: d: is 4");
}

TEST(FaultList, HoldsAHundredAndCountsTheRest) {
  FaultList faults("f");
  const JsonNode root = parseJson("{}", "f");
  for (int i = 0; i < 99; ++i) faults.add(root, "a" + std::to_string(i), "is 1");
  EXPECT_FALSE(faults.isFull());
  faults.add(root, "b", "is 1");
  EXPECT_TRUE(faults.isFull());
  EXPECT_EQ(thrownBy(faults).size(), 100u);
  faults.add(root, "c", "is 1");
  faults.addOfValue(root, Fault{"d", "is 1"});
  const JsonNode other = parseJson("{\"x\": 1}", "f");
  ObjectReader(faults, other, "").finish();
  EXPECT_EQ(faults.faults().size(), 100u);
  EXPECT_EQ(toText(thrownBy(faults).back()), "f: and 3 more faults");
}

TEST(FaultList, KnowsWhatItIsAbout) {
  FaultList faults("f");
  faults.add(parseJson("{}", "f"), "object.masses_kg[1]", "is 0");
  for (const char* key : {"object", "object.masses_kg", "object.masses_kg[1]", "object.masses_kg[1].x"})
    EXPECT_TRUE(faults.isAbout(key)) << key;
  for (const char* key : {"obj", "object.mass", "object.masses_kg[2]", "objects", "object.masses_kg[11]"})
    EXPECT_FALSE(faults.isAbout(key)) << key;
}

const char* const kStudy = "{\"object\":\n {\"masses\": [1, {\"kg\": 2}],\n  \"curve\": \"x+\"}}";
std::string placedOf(const std::string& key, const std::string& what = "is wrong") {
  return toText(atTheirPlaces({Fault{key, what, "less"}}, kStudy, "f"));
}

TEST(FaultList, AFaultOfAValueStandsWhereItsKeyStands) {
  EXPECT_EQ(placedOf("object"), "f:2:2: object: is wrong; allowed: less");
  EXPECT_EQ(placedOf("object.masses[0]"), "f:2:14: object.masses[0]: is wrong; allowed: less");
  EXPECT_EQ(placedOf("object.masses[1].kg"), "f:2:24: object.masses[1].kg: is wrong; allowed: less");
  EXPECT_EQ(placedOf("object.masses[2]"), "f:2:13: object.masses[2]: is wrong; allowed: less") << "the list, that is too short";
  EXPECT_EQ(placedOf("object.lengths[2]"), "f:2:2: object.lengths[2]: is missing, and by default is wrong; allowed: less");
  EXPECT_EQ(placedOf("object.lengths", "has 0 elements"), "f:2:2: object.lengths: is missing; allowed: less") << "no default";
  EXPECT_EQ(placedOf("object.curve.x"), "f:3:12: object.curve.x: is wrong; allowed: less") << "what has no members lacks none";
  EXPECT_EQ(placedOf(""), "f:1:1: is wrong; allowed: less");
  const std::vector<Fault> inText = atTheirPlaces({Fault{"object.curve", "ends", "", FilePlace{"", 1, 2}}}, kStudy, "f");
  EXPECT_EQ(toText(inText), "f:3:14: object.curve: ends") << "counted behind the quote";
  const std::vector<Fault> named = atTheirPlaces({Fault{"object.curve", "ends", "", FilePlace{"bow.json", 4, 2}}}, kStudy, "f");
  EXPECT_EQ(toText(named), "bow.json:4:2: object.curve: ends") << "a file that this one names";
  EXPECT_EQ(toText(atTheirPlaces({Fault{"object", "is wrong"}}, "", "f")), "object: is wrong");
  EXPECT_TRUE(atTheirPlaces({}, "no JSON", "f").empty());
}

TEST(FaultList, AFaultOfTheFileGoesBeforeThatOfItsValue) {
  const JsonNode root = parseJson(kStudy, "f");
  FaultList faults("f");
  faults.add(*root.find("object"), "object.masses[0]", "is nan", anyNumber().allowed);
  faults.add(*root.find("object"), "object.curve", "is 3", "a string");
  faults.addOfValue(root, Fault{"object.masses[0]", "is nan", "more than 0 kg"});
  faults.addOfValue(root, Fault{"object.curve", "is empty", "a formula"});
  faults.addOfValue(root, Fault{"object", "is empty", "something"});
  faults.addOfValue(root, Fault{"object.masses[1]", "is 2", "less"});
  faults.addOfValue(root, Fault{"object.masses[1]", "is 2", "more"});
  EXPECT_EQ(toText(faults.faults()),
            "f:2:2: object.masses[0]: is nan; allowed: more than 0 kg\nf:2:2: object.curve: is 3; allowed: a string\n"
            "f:2:17: object.masses[1]: is 2; allowed: less\nf:2:17: object.masses[1]: is 2; allowed: more");
}

// A change is one member, whose name has dots and may stand for all elements of a list.
TEST(AtTheirPlaces, OfAChangeIsItsMember) {
  const std::string text = R"({ "kinds": { "a": { "task.duration_s": -1, "object.masses_kg[*]": -2 } } })";
  const auto told = [&](const char* key) { return toText(atTheirPlaces({Fault{key, "is wrong"}}, text, "f")[0]); };
  EXPECT_EQ(told("kinds.a.task.duration_s"), "f:1:40: kinds.a.task.duration_s: is wrong");
  EXPECT_EQ(told("kinds.a.object.masses_kg[3]"), "f:1:67: kinds.a.object.masses_kg[3]: is wrong");
}

}  // namespace
}  // namespace reachlab
