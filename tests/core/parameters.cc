// Reading of parameter files: values arrive, variations are all run, and each mistake gives one
// line that names the place and the remedy. Expected texts are read against the inputs line by line from the files
// below; the numbers of runs are products of the numbers of values.

#include <isochor/core/parameters.h>
#include <isochor/core/patterns.h>

#include <fstream>
#include <iostream>

using namespace isochor;
namespace fs = std::filesystem;

namespace
{
  const fs::path file = "test_parameters.prm";

  void write(const fs::path &path, const std::string &text)
  {
    std::ofstream(path) << text;
  }

  void declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Scene");
    prm.declare_entry("Dimension", "3", dealii::Patterns::Selection("2|3"));
    prm.declare_entry("Young's modulus", "1e6", NumberPattern::above(0));
    prm.declare_entry("Poisson ratio", "0.3", NumberPattern::above(-1).and_at_most(0.5));
    prm.declare_entry("Density", "1000", dealii::Patterns::Double(0));
    prm.declare_entry("Fixed", "", dealii::Patterns::Anything());
    prm.leave_subsection();
    prm.enter_subsection("Method");
    prm.declare_entry("Element", "P1", dealii::Patterns::Selection("P1|P2|P1-P1"));
    prm.declare_entry("Steps", "1", dealii::Patterns::Integer(1));
    prm.declare_entry("Quiet", "false", dealii::Patterns::Bool());
    prm.enter_subsection("Newton");
    prm.declare_entry("Tolerance", "1e-8", dealii::Patterns::Double(0, 1));
    prm.leave_subsection();
    prm.leave_subsection();
  }

  void expect_error(const std::string &title, const std::function<void()> &action)
  {
    std::cout << title << "\n  ";
    try
      {
        action();
        std::cout << "NO ERROR\n";
      }
    catch (const UserError &error)
      {
        const std::string text = error.what();
        std::cout << text << (text.find('\n') != std::string::npos ? "  MORE THAN ONE LINE" : "")
                  << '\n';
      }
    catch (const std::exception &error)
      {
        std::cout << "NOT A USER ERROR: " << error.what() << '\n';
      }
  }

  void refuse(const std::string              &title,
              const std::string              &text,
              const std::vector<std::string> &overrides = {})
  {
    write(file, text);
    expect_error(title, [&]() {
      dealii::MultipleParameterLoop prm;
      declare(prm);
      read_parameter_file(prm, file, overrides);
    });
  }

  struct Runs : dealii::MultipleParameterLoop::UserClass
  {
    void create_new(unsigned int) override
    {
    }
    void run(dealii::ParameterHandler &prm) override
    {
      std::cout << "  run: " << prm.get({"Method"}, "Element") << ", nu "
                << prm.get({"Scene"}, "Poisson ratio") << ", steps " << prm.get({"Method"}, "Steps")
                << '\n';
    }
  };

  void loop(const std::string &text, const std::vector<std::string> &overrides = {})
  {
    write(file, text);
    dealii::MultipleParameterLoop prm;
    declare(prm);
    for (const Variation &variation : read_parameter_file(prm, file, overrides))
      {
        std::cout << "  " << variation.path() << ":";
        for (const std::string &value : variation.values)
          std::cout << " [" << value << "]";
        std::cout << '\n';
      }
    Runs runs;
    prm.loop(runs);
  }
} // namespace

int main()
{
  const std::string in_scene = "subsection Scene\n", end = "end\n";

  std::cout << "values\n";
  {
    write(file,
          "\xEF\xBB\xBF# a comment\nsubsection Scene\r\n  set Young's modulus = 266e3 # Pa\n"
          "\tset\tPoisson ratio =\t0.4\n  set Fixed = left, \\\n    right\nend\nSUBSECTION Method\n"
          "  subsection Newton\n    SET Tolerance = 1e-6\n  end\nEND\ninclude test_parameters.inc");
    write("test_parameters.inc", "subsection Method\nset Steps = 4\nend\n");
    dealii::ParameterHandler prm;
    declare(prm);
    read_parameter_file(prm, file, {"Scene/Density = 1070", "Method/Newton/Tolerance=1e-7"});
    std::cout << "  " << prm.get({"Scene"}, "Young's modulus") << " | "
              << prm.get({"Scene"}, "Poisson ratio") << " | " << prm.get({"Scene"}, "Density")
              << " | " << prm.get({"Scene"}, "Fixed") << " | " << prm.get({"Method"}, "Steps")
              << " | " << prm.get({"Method", "Newton"}, "Tolerance") << " | "
              << prm.get({"Method"}, "Element") << '\n';
  }

  std::cout << "no variation: 1 run\n";
  loop("subsection Method\nset Steps = 3\nend\n");
  std::cout << "3 elements, 2 ratios: 6 runs\n";
  loop("subsection Method\nset Element = {{P1 | P2|P1-P1}}\nend\nsubsection Scene\n"
       "set Poisson ratio = 0.{{3|49}}\nend\n");
  std::cout << "single braces and an override that varies: 4 runs\n";
  loop("subsection Method\nset Element = {P1|P2}\nset Steps=7\nend\n", {"Method/Steps={{1|2}}"});
  std::cout << "an override ends a variation: 1 run\n";
  loop("subsection Method\nset Element = {{P1|P2}}\nend\n", {"Method/Element=P1-P1"});

  refuse("unknown key", in_scene + "\n  set Colour = red\n" + end);
  refuse("misspelt key", in_scene + "  set Youngs Modulus = 1\n" + end);
  refuse("key of another section", in_scene + "set Tolerance = 1\n" + end);
  refuse("key outside of sections", "set Density = 1\n");
  refuse("misspelt section", "subsection Scenes\n" + end);
  refuse("unknown section", "# first\nsubsection Kitchen\n" + end);
  refuse("end forgotten between sections", in_scene + "subsection Method\nend\nend\n");
  refuse("negative density", in_scene + "set Density = -3\n" + end);
  refuse("nu = 0.51", in_scene + "set Poisson ratio = 0.51\n" + end);
  refuse("nu = -1", in_scene + "set Poisson ratio = -1\n" + end);
  refuse("E = 0", in_scene + "set Young's modulus = 0\n" + end);
  refuse("E = nan", in_scene + "set Young's modulus = nan\n" + end);
  refuse("E with a unit", in_scene + "set Young's modulus = 266 kPa\n" + end);
  refuse("not one of a selection", "subsection Method\nset Element = P4\n" + end);
  refuse("not whole", "subsection Method\nset Steps = 1.5\n" + end);
  refuse("not of a range", "subsection Method\nsubsection Newton\nset Tolerance=2\n" + end + end);
  refuse("neither true nor false", "subsection Method\nset Quiet = maybe\n" + end);
  refuse("bad value in a variation", in_scene + "set Poisson ratio = {{0.3|0.6}}\n" + end);
  refuse("brace not closed", in_scene + "set Poisson ratio = {{0.3|0.4}\n" + end);
  refuse("two variations in a value", in_scene + "set Fixed = {{a|b}}, {{c|d}}\n" + end);
  refuse("a value twice", in_scene + "set Fixed = {{a|b|a}}\n" + end);
  refuse("nothing in the braces", in_scene + "set Fixed = {{}}\n" + end);
  refuse("set twice", in_scene + "set Density = 1\n\nset Density = 2\n" + end);
  refuse("end missing", "\nsubsection Method\n  subsection Newton\n  end\n");
  refuse("end too many", in_scene + end + end);
  refuse("line without set", in_scene + "Density = 1\n" + end);
  refuse("set without =", in_scene + "set Density 1\n" + end);
  refuse("empty file", "");
  refuse("comments only", "# nothing\n\n");
  refuse("file that includes itself", "include test_parameters.prm\n" + in_scene + end);
  write("test_parameters.inc", "\nsubsection Scene\nset Densty = 4\nend\n");
  refuse("mistake in an included file", "\ninclude test_parameters.inc\n");
  refuse("missing included file", "include nowhere.inc\n");

  const std::string good = in_scene + "set Density = 1\n" + end;
  refuse("override without =", good, {"Scene/Density"});
  refuse("override without section", good, {"Density=3"});
  refuse("override of a misspelt section", good, {"Scen/Density=3"});
  refuse("override of a misspelt key", good, {"Scene/density=3"});
  refuse("override with a bad value", good, {"Scene/Density=-3"});
  refuse("override with a bad variation", good, {"Scene/Density={{1|-3}}"});

  const auto read = [](const fs::path &path) {
    dealii::ParameterHandler prm;
    declare(prm);
    read_parameter_file(prm, path);
  };
  expect_error("missing file", [&]() { read("nowhere.prm"); });
  fs::create_directories("test_parameters.folder");
  expect_error("folder", [&]() { read("test_parameters.folder"); });

  std::cout << "patterns in words\n";
  namespace Patterns = dealii::Patterns;
  for (const std::string &description : {Patterns::Integer().description(),
                                         Patterns::Integer(0, 5).description(),
                                         Patterns::Double().description(),
                                         Patterns::Double(0.5).description(),
                                         Patterns::Anything().description(),
                                         Patterns::List(Patterns::Integer(1)).description(),
                                         NumberPattern::any().and_below(3).description({})})
    std::cout << "  " << plain_words(description) << '\n';

  std::cout << "lists\n";
  for (const std::string text : {"", " a ; b;", "a;;b", "max(1;2); c", ";"})
    {
      std::cout << "  '" << text << "':";
      for (const std::string &piece : split_list(text, ';'))
        std::cout << " [" << piece << "]";
      std::cout << '\n';
    }

  std::cout << "numbers\n";
  std::cout << "  " << parse_number(" +2.5e-1 ", "") << ' ' << parse_whole_number("12", 1, "")
            << ' ' << parse_vector<3>("1, -2,3e0", "") << '\n';
  for (const std::string text : {"", "1 2", "0x10", "inf", "1e999", "two"})
    expect_error("  '" + text + "'", [&]() { parse_number(text, "What"); });
  expect_error("  -1, at least 0", []() { parse_whole_number("-1", 0, "What"); });
  expect_error("  2 of 3", []() { parse_vector<3>("1, 2", "What"); });
}
