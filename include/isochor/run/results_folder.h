#pragma once

// The folder that results go to: what may be replaced there, and whose results it holds.

#include <isochor/run/study.h>

namespace isochor
{
  /// May results go there? What an earlier run left there goes only with --overwrite, and stays
  /// with --restart. Throws UserError. Rank 0 only.
  void check_folder(const std::filesystem::path &folder, const Invocation &invocation);

  /// Make @p folder, without the results of an earlier run unless it is restarted, and put the
  /// parameters there. Throws UserError. Rank 0 only.
  void prepare_folder(const std::filesystem::path &folder, const Invocation &invocation);

  /// Throws UserError if the folder holds a study of other parameters.
  void check_same_study(const std::filesystem::path &folder, const Invocation &invocation);

  /// "Section/Key" and value of all parameters of @p sections.
  Identity values_of(dealii::ParameterHandler &prm, const std::vector<std::string> &sections);
} // namespace isochor
