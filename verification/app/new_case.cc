#include <cases/case_file/case_file.h>
#include <cases/case_file/vary_case.h>
#include <cases/data_folder.h>
#include <cases/error.h>
#include <verification/app/commands.h>
#include <verification/app/new_case.h>
#include <verification/record/json_values.h>

#include <fmt/format.h>

#include <filesystem>

namespace meltfront::verification
{
  int new_case(const NewCaseArguments &arguments)
  {
    const std::string file
        = arguments.name.ends_with(".prm") ? arguments.name : arguments.name + ".prm";
    if(std::filesystem::exists(file))
      throw cases::InputError(
          fmt::format("there is a file {} already; name another one", file));
    const cases::Case begun
        = arguments.like.empty() ? cases::read_case(cases::library_path("templates/slab"))
                                 : cases::load_case(arguments.like);
    const std::string head
        = arguments.like.empty()
              ? ""
              : fmt::format("# Begun as {}: {}. Its acceptance criteria are left out.\n",
                            begun.scene.name, begun.title);
    write_atomically(file, head + cases::text_without_figures(begun.text, file));
    fmt::print("Written to {0}. What comes next:\n"
               "  {2} compare {0} --within 30    every method that can, with "
               "error bars\n"
               "  {2} run {0} --method {1} --n 40    one run, with fields for "
               "ParaView\n"
               "  {2} list keys    what a case file may say\n",
               file, "fem-enthalpy", cases::program_call());
    return all_well;
  }
} // namespace meltfront::verification
