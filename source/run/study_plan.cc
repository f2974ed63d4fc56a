#include <isochor/run/study.h>
#include <isochor/run/study_plan.h>

#include <algorithm>

namespace isochor
{
  void StudyOptions::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Study");
    prm.declare_entry("Title",
                      "",
                      dealii::Patterns::Anything(),
                      "Heading of table and charts. Empty: the name of the parameter file.");
    prm.declare_entry(
        "Reference",
        "",
        dealii::Patterns::Anything(),
        "What every run is compared with: 'Section/Key = value; ...'. The reference "
        "of a run has the run's own values but these, e.g. 'Method/Element = P3-P2; "
        "Scene/Mesh size = 0.03'. Runs that the variations do not contain are added.");
    prm.declare_entry("Reference check",
                      "",
                      dealii::Patterns::Anything(),
                      "A second, independent reference in the same form; its difference from the "
                      "first is reported as the reference's uncertainty.");
    prm.declare_entry("Reference values",
                      "",
                      dealii::Patterns::Anything(),
                      "References known from elsewhere: 'probe = value; ...', in the probe's "
                      "unit, e.g. 'tip y = -0.478'. They go before Reference.");
    prm.declare_entry(
        "Most unknowns",
        "0",
        dealii::Patterns::Integer(0),
        "Variations with more unknowns are left out, so that a grid of elements and "
        "mesh sizes takes each element to meshes that suit it; references are not. 0: "
        "none is left out. No unit.");
    prm.leave_subsection();
  }

  StudyOptions StudyOptions::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Study");
    const StudyOptions options{prm.get("Title"),
                               prm.get("Reference"),
                               prm.get("Reference check"),
                               prm.get("Reference values"),
                               static_cast<unsigned int>(prm.get_integer("Most unknowns"))};
    prm.leave_subsection();
    return options;
  }

  namespace
  {
    /// "a = b; c = d".
    std::vector<std::pair<std::string, std::string>> parse_pairs(const std::string &text,
                                                                 const std::string &what)
    {
      std::vector<std::pair<std::string, std::string>> pairs;
      for (const std::string &entry : split_list(text, ';'))
        {
          const auto equals = entry.find('=');
          if (equals == std::string::npos)
            throw UserError(what + ": entry '" + entry + "' is not of the form 'name = value'");
          pairs.emplace_back(trim(entry.substr(0, equals)), trim(entry.substr(equals + 1)));
        }
      return pairs;
    }

    /// Collects what MultipleParameterLoop runs through.
    class Collector : public dealii::MultipleParameterLoop::UserClass
    {
    public:
      explicit Collector(const std::vector<Variation> &variations)
        : variations(variations)
      {
      }

      void create_new(const unsigned int) override
      {
      }

      void run(dealii::ParameterHandler &prm) override
      {
        Assignments assignments;
        for (const Variation &variation : variations)
          {
            for (const std::string &section : variation.sections)
              prm.enter_subsection(section);
            assignments[variation.path()] = prm.get(variation.key);
            for (std::size_t depth = 0; depth < variation.sections.size(); ++depth)
              prm.leave_subsection();
          }
        grid.push_back(assignments);
      }

      std::vector<Assignments> grid;

    private:
      const std::vector<Variation> &variations;
    };

    /// The run of @p plan with these assignments, added if there is none.
    std::size_t find_or_add(StudyPlan &plan, const Assignments &assignments)
    {
      for (std::size_t k = 0; k < plan.runs.size(); ++k)
        if (plan.runs[k].assignments == assignments)
          return k;
      plan.runs.push_back({assignments, false, {}, {}});
      return plan.runs.size() - 1;
    }
  } // namespace

  StudyPlan plan_study(const std::filesystem::path &file, const std::vector<std::string> &overrides)
  {
    dealii::MultipleParameterLoop prm;
    declare_parameters(prm);
    const std::vector<Variation> variations = read_parameter_file(prm, file, overrides);
    const StudyOptions           options    = StudyOptions::parse(prm);

    StudyPlan plan;
    plan.most_unknowns = options.most_unknowns;
    plan.title         = options.title.empty() ? file.stem().string() : options.title;
    for (const Variation &variation : variations)
      plan.keys.push_back(variation.path());

    const auto reference = parse_pairs(options.reference, "Study/Reference");
    const auto check     = parse_pairs(options.reference_check, "Study/Reference check");
    for (const auto &pairs : {reference, check})
      for (const auto &pair : pairs)
        if (std::find(plan.keys.begin(), plan.keys.end(), pair.first) == plan.keys.end())
          plan.keys.push_back(pair.first);
    for (const auto &[probe, value] :
         parse_pairs(options.reference_values, "Study/Reference values"))
      plan.reference_values[probe] = parse_number(value, "Study/Reference values: '" + probe + "'");

    Collector collector(variations);
    prm.loop(collector);
    for (Assignments &assignments : collector.grid)
      {
        std::vector<std::string> all = overrides;
        for (const auto &[path, value] : assignments)
          all.push_back(path + "=" + value);
        // Checks the references' keys and values as well, in words.
        for (const auto &[key, pairs] :
             {std::pair("Reference", reference), std::pair("Reference check", check)})
          for (const auto &[path, value] : pairs)
            {
              dealii::ParameterHandler scratch;
              declare_parameters(scratch);
              std::vector<std::string> with = all;
              with.push_back(path + "=" + value);
              try
                {
                  read_parameter_file(scratch, file, with);
                }
              catch (const UserError &error)
                {
                  const std::string text = error.what(), override = "--set ";
                  if (!text.starts_with(override + "'" + path)) // the user wrote no --set
                    throw;
                  throw UserError(std::string("Study/") + key + ": "
                                  + text.substr(override.size()));
                }
            }
        // Keys that only a reference changes: the file's own value for the others, or the default,
        // which a handler that has read a reference's value does not know any more.
        dealii::ParameterHandler plain;
        declare_parameters(plain);
        read_parameter_file(plain, file, all);
        plan.has_error_estimates |= plain.get({"Output"}, "Error estimates") == "true";
        plan.has_automatic |= plain.get({"Method"}, "Element") == automatic_element;
        for (const std::string &path : plan.keys)
          if (assignments.count(path) == 0)
            {
              const auto slash = path.rfind('/');
              plain.enter_subsection(path.substr(0, slash));
              assignments[path] = plain.get(path.substr(slash + 1));
              plain.leave_subsection();
            }
        plan.runs.push_back({assignments, true, {}, {}});
      }

    const std::size_t n_grid = plan.runs.size();
    const auto        with   = [](Assignments assignments, const auto &pairs) {
      for (const auto &[path, value] : pairs)
        assignments[path] = value;
      return assignments;
    };
    for (std::size_t k = 0; k < n_grid; ++k)
      {
        if (!reference.empty())
          plan.runs[k].reference = find_or_add(plan, with(plan.runs[k].assignments, reference));
        if (!check.empty())
          plan.runs[k].check = find_or_add(plan, with(plan.runs[k].assignments, check));
      }
    // A run made only as a reference is measured against itself, and so shows its uncertainty.
    for (std::size_t k = n_grid; k < plan.runs.size(); ++k)
      for (std::size_t other = 0; other < n_grid; ++other)
        if (plan.runs[other].reference == k)
          {
            plan.runs[k].reference = k;
            plan.runs[k].check     = plan.runs[other].check;
          }

    // References first, so that each row of the table has its errors at once.
    std::vector<char> done(plan.runs.size(), 0);
    const auto        schedule = [&](const std::size_t k) {
      if (!done[k])
        plan.order.push_back(k);
      done[k] = 1;
    };
    for (const PlannedRun &run : plan.runs)
      for (const auto &needed : {run.reference, run.check})
        if (needed)
          schedule(*needed);
    for (std::size_t k = 0; k < plan.runs.size(); ++k)
      schedule(k);
    return plan;
  }
} // namespace isochor
