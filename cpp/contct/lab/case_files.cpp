#include "contct/lab/case_files.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <utility>

#include "contct/numeric/bits.hpp"
#include "contct/outside/registry.hpp"

namespace contct {
namespace {

/// A number as C++ has it.
std::string cpp_number(double x) {
  const std::string sign = std::signbit(x) ? "-" : "";
  if (std::isnan(x)) return "std::numeric_limits<double>::quiet_NaN()";
  if (std::isinf(x)) return sign + "std::numeric_limits<double>::infinity()";
  return hexfloat(x);
}

template <class List, class Words>
std::string joined(const List& list, Words words) {
  std::string all;
  for (const auto& x : list) all += (all.empty() ? "" : ", ") + words(x);
  return "{" + all + "}";
}

std::string cpp_reals(const std::vector<double>& list) {
  return joined(list, cpp_number);
}

std::string cpp_wholes(const std::vector<int>& list) {
  return joined(list, [](int x) { return std::to_string(x); });
}

/// A name for a test: its characters must not mean anything to Catch2.
std::string test_name(const std::string& kernel) {
  std::string name;
  for (const char ch : kernel) name += std::isalnum(static_cast<unsigned char>(ch)) != 0 ? ch : ' ';
  return name;
}

std::string cpp_string(const std::string& text) {
  std::string out = "\"";
  for (const char ch : text) {
    if (ch == '"' || ch == '\\') out += '\\';
    out += ch;
  }
  return out + "\"";
}

/// A FORTRAN assignment; what no literal can say is computed from Z, which is zero. Literals have so many
/// digits that they are read back exactly.
std::string fortran_assignment(const std::string& name, double x, int real_bytes) {
  std::string value;
  const std::string sign = std::signbit(x) ? "-" : "";
  if (std::isnan(x)) {
    value = "Z / Z";
  } else if (std::isinf(x)) {
    value = sign + "1. / Z";
  } else {
    char text[64];
    (void)std::snprintf(text, sizeof text, real_bytes == 4 ? "%.8E" : "%.16E", x);
    value = x == 0.0 ? (std::signbit(x) ? "-Z" : "0.") : text;
  }
  return "      " + name + " = " + value + "\n";
}

std::string element(const char* array, std::size_t index) {
  std::string name = array;
  name += "(";
  name += std::to_string(index + 1);
  return name + ")";
}

/// One call of the main program.
void append_fortran_call(const found_case& c, std::size_t number, std::string& text) {
  const call_inputs<double>& in = c.calls[number];
  text += "      INDOF = " + std::to_string(in.dof.indof) +
          "\n      NDOFPN = " + std::to_string(in.dof.ndofpn) + "\n";
  for (std::size_t dof = 0; dof < in.dd.size(); ++dof) {
    if (std::isnan(in.dd[dof]) && std::isnan(in.dtest[dof])) continue;
    text += fortran_assignment(element("DD", dof), in.dd[dof], c.real_bytes);
    text += fortran_assignment(element("DTEST", dof), in.dtest[dof], c.real_bytes);
  }
  for (std::size_t i = 0; i < in.pairs(); ++i) {
    text += fortran_assignment(element("CC", i), in.cc[i], c.real_bytes);
    text += "      " + element("ID", i) + " = " + std::to_string(in.id[i]) + "\n";
    text += "      " + element("ISEP", i) + " = " + std::to_string(in.isep[i]) + "\n";
    text += "      " + element("ISURF", i) + " = " + std::to_string(in.isurf[i]) + "\n";
  }
  text +=
      "      CALL CONTCT (DD, DTEST, CC, SS, SMIN, ID, ISEP, ISURF, " + std::to_string(in.pairs()) + ")\n";
  text += "      WRITE (*,*) 'SMIN', SMIN\n";
  text += "C     " + c.what.leader + ": " + hexfloat(c.leader[number].smin) + "\n";
  if (in.pairs() == 0) return;
  text += "      DO 10" + std::to_string(number % 90 + 10) + " I = 1, " + std::to_string(in.pairs()) + "\n";
  text += " 10" + std::to_string(number % 90 + 10) + " WRITE (*,*) I, SS(I), ISEP(I)\n";
  for (std::size_t i = 0; i < in.pairs(); ++i) {
    text += "C     " + c.what.leader + ": " + std::to_string(i + 1) + " " + hexfloat(c.leader[number].ss[i]) +
            " " + std::to_string(c.leader[number].isep[i]) + "\n";
  }
}

/// Comment lines of a fixed-form program end at column 72, between words where they can.
std::string fortran_comment(const std::string& words) {
  constexpr std::size_t width = 66;
  std::string text;
  for (std::size_t from = 0; from < words.size();) {
    std::size_t to = std::min(from + width, words.size());
    const std::size_t blank = words.rfind(' ', to);
    if (to < words.size() && blank != std::string::npos && blank > from) to = blank;
    text += "C     " + words.substr(from, to - from) + "\n";
    from = std::min(words.find_first_not_of(' ', to), words.size());
  }
  return text;
}

}  // namespace

std::string trace_of(const found_case& c, trace_header h) {
  for (const std::string& line : words_of(c.what)) h.about.push_back(line);
  std::string text;
  append_header(h, text);
  for (std::size_t i = 0; i < c.calls.size(); ++i) {
    append_inputs(static_cast<std::int64_t>(i) + 1, "", c.calls[i], text);
    append_answer(c.leader[i].smin, c.leader[i].ss, c.leader[i].isep, c.leader[i].text, text);
  }
  return text;
}

std::string catch_test_of(const found_case& c) {
  std::string text = "// Found by contct fuzz, and shrunk.\n";
  for (const std::string& line : words_of(c.what)) text += "// " + line + "\n";
  text +=
      "#include <catch2/catch.hpp>\n#include <limits>\n#include <vector>\n\n"
      "#include \"contct/kernel/call_inputs.hpp\"\n#include \"contct/kernel/kernel.hpp\"\n"
      "#include \"contct/numeric/bits.hpp\"\n\n"
      "TEST_CASE(\"" +
      test_name(c.what.follower) + " answers as " + test_name(c.what.leader) +
      " does\") {\n"
      "  const auto kernel = contct::make_kernel(" +
      cpp_string(c.what.follower) +
      ");\n"
      "  contct::call_inputs<double> in;\n  contct::call_outputs out;\n";
  for (std::size_t i = 0; i < c.calls.size(); ++i) {
    const call_inputs<double>& in = c.calls[i];
    text += "\n  in.dd = " + cpp_reals(in.dd) + ";\n  in.dtest = " + cpp_reals(in.dtest) +
            ";\n  in.cc = " + cpp_reals(in.cc) + ";\n  in.id = " + cpp_wholes(in.id) +
            ";\n  in.isep = " + cpp_wholes(in.isep) + ";\n  in.isurf = " + cpp_wholes(in.isurf) +
            ";\n  in.dof = {" + std::to_string(in.dof.indof) + ", " + std::to_string(in.dof.ndofpn) +
            "};\n  {\n    contct::call<double> asked = out.prepare(in);\n"
            "    kernel->answer(asked);\n    CHECK(contct::same_bits(asked.smin, " +
            cpp_number(c.leader[i].smin) + "));\n";
    for (std::size_t pair = 0; pair < in.pairs(); ++pair) {
      text += "    CHECK(contct::same_bits(out.ss[" + std::to_string(pair) + "], " +
              cpp_number(c.leader[i].ss[pair]) + "));\n";
    }
    text += "    CHECK(out.isep == std::vector<int>" + cpp_wholes(c.leader[i].isep) + ");\n  }\n";
  }
  return text + "}\n";
}

std::string fortran_main_of(const found_case& c) {
  std::size_t dofs = 1;
  std::size_t pairs = 1;
  for (const auto& in : c.calls) {
    dofs = std::max(dofs, in.dd.size());
    pairs = std::max(pairs, in.pairs());
  }
  const std::string n = std::to_string(dofs);
  const std::string m = std::to_string(pairs);
  std::string text;
  for (const std::string& line : words_of(c.what)) text += fortran_comment(line);
  text += fortran_comment(std::string("gfortran -std=legacy -ffp-contract=off -fno-range-check ") +
                          (c.real_bytes == 8 ? "-fdefault-real-8 " : "") + "this.f contct.f");
  text += "      PROGRAM FOUND\n      COMMON /DOF/ INDOF,NDOFPN\n      DIMENSION DD(" + n + "), DTEST(" + n +
          "), CC(" + m + "),\n     &  SS(" + m + "), ID(" + m + "), ISEP(" + m + "), ISURF(" + m +
          ")\n      Z = 0.\n";
  for (std::size_t i = 0; i < c.calls.size(); ++i) append_fortran_call(c, i, text);
  return text + "      END\n";
}

}  // namespace contct
