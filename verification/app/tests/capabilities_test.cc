#include <cases/case_file/case_file.h>
#include <cases/error.h>
#include <verification/app/methods.h>
#include <verification/matrix/matrix_file.h>

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace meltfront::verification
{
  namespace
  {
    using Pair = std::pair<std::string, std::string>;

    /** Of a method in a block of a matrix, each with the first of its values. */
    cases::Options options_of(const MatrixBlock &block, const std::string &method)
    {
      cases::Options options(method_named(method).option_declarations());
      for(const OptionAxis &axis : block.options)
        if(axis.method == method)
          options.set(axis.key, axis.values.front());
      return options;
    }

    /** Cases and methods that the matrices of the library bring together, with options.
     */
    std::map<Pair, cases::Options> pairs_of_the_library()
    {
      std::map<Pair, cases::Options> pairs;
      for(const std::string &name : matrix_names())
      {
        const Matrix matrix = load_matrix(name);
        // There every method stands beside every case: refusals are what it shows.
        if(matrix.hard_cases)
          continue;
        for(const MatrixBlock &block : matrix.blocks)
          for(const std::string &case_name : block.cases)
            for(const std::string &method : block.methods)
              pairs.emplace(Pair(case_name, method), options_of(block, method));
      }
      return pairs;
    }

    std::string refusal(const cases::Case &c, const cases::Method &method,
                        const cases::Options &options)
    {
      const cases::EffectSet effects = cases::effects_called_for(c.scene);
      try
      {
        cases::require_capable(method, cases::simulated_scene(c.scene, effects), effects,
                               1, options);
      }
      catch(const cases::Refusal &error)
      {
        return error.what();
      }
      return {};
    }
  } // namespace

  // What a matrix of the library runs is meant to be taken; a method that refuses in
  // such a matrix is named here, with its case.
  TEST(Capabilities, TakeWhatTheLibraryRuns)
  {
    const std::set<Pair> refused{};
    std::map<std::string, cases::Case> library;
    for(const auto &[pair, options] : pairs_of_the_library())
    {
      const auto &[case_name, method] = pair;
      if(!library.contains(case_name))
        library.emplace(case_name, cases::load_case(case_name));
      const std::string reason
          = refusal(library.at(case_name), method_named(method), options);
      EXPECT_EQ(!reason.empty(), refused.contains({case_name, method}))
          << case_name << ", " << method << ": " << reason;
    }
  }
} // namespace meltfront::verification
