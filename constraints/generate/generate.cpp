// Build-time program: reads the catalogue's definitions and writes one C++ file with a function for each and the definitions' own text,
// so that the library needs no file at run time. `reachlab_generate OUTPUT DEFINITION…`
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

#include "base/error.h"
#include "base/fault.h"
#include "base/json/json_tree.h"
#include "base/text_file.h"
#include "constraints/catalogue/definition.h"
#include "constraints/formula/cpp_writer.h"

namespace {

using namespace reachlab;
using namespace reachlab::constraints;

std::string generate(const std::vector<std::string>& files) {
  std::string functions, table;
  for (const std::string& file : files) {
    const std::string text = readTextFile(file);
    const Definition definition = parseDefinition(text, file);
    if (fmt::format("/{}.json", definition.name) != file.substr(file.find_last_of('/')))
      throw FaultError(Fault{"name", "is " + definition.name, "the file's name", FilePlace{file}});
    const std::string function = "evaluate" + upperCamel(definition.name);
    const auto formula = compileFormula(formulaOf(definition), file);
    const bool curve = definition.kind == ConstraintKind::Curve;
    functions += writeEvaluator(*formula, function) + "\n";
    if (curve) functions += writeBatchEvaluator(*formula, function) + "\n";
    table += fmt::format("    {{R\"definition({})definition\",\n     {}}},\n", text,
                         curve ? fmt::format("{0}, {0}Batch, nullptr", function) : "nullptr, nullptr, " + function);
  }
  return "// Generated from constraints/definitions by reachlab_generate; do not edit.\n#include <cmath>\n\n"
         "#include \"base/math/elementary.h\"\n#include \"constraints/catalogue/generated_catalogue.h\"\n#include \"constraints/curve_batch.h\"\n#include \"constraints/formula/sincos.h\"\n\nnamespace reachlab::constraints "
         "{\nnamespace {\n\n" +
         functions + "constexpr GeneratedEntry kEntries[] = {\n" + table +
         "};\n\n}  // namespace\n\nstd::span<const GeneratedEntry> generatedEntries() { return kEntries; }\n\n}  // namespace "
         "reachlab::constraints\n";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: reachlab_generate OUTPUT DEFINITION...\n");
    return 2;
  }
  try {
    std::vector<std::string> files(argv + 2, argv + argc);
    std::sort(files.begin(), files.end());
    const std::string code = generate(files);
    std::ofstream out(argv[1], std::ios::binary);
    if (!(out << code).flush()) throw ResourceError(fmt::format("{}: can't be written", argv[1]));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
  return 0;
}
