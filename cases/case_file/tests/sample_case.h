#ifndef meltfront_cases_case_file_tests_sample_case_h
#define meltfront_cases_case_file_tests_sample_case_h

#include <cases/case_file/case_file.h>
#include <cases/error.h>

#include <stdexcept>
#include <string>

namespace meltfront::cases::test
{
  /** A complete case: water that freezes in a slab. Line numbers are used by tests. */
  inline const std::string slab = R"(set title = A slab
subsection Scene
  set symmetry = planar
  set end time = 100
  subsection Domain
    set shape = slab
    set length = 0.1
  end
  subsection Material
    set latent heat = 333500
    set melting temperature = 0
    subsection Solid
      set conductivity = 2.2
      set specific heat capacity = 2090
      set density = 1000
    end
    subsection Liquid
      set conductivity = 0.591
    end
  end
  subsection Initial state
    set temperature = 10
  end
  subsection Walls
    subsection x_min
      set kind = fixed temperature
      set temperature = -10
    end
    subsection x_max
      set kind = insulated
    end
  end
end
)";

  /** A complete case: a line sink in an insulated square. */
  inline const std::string square = R"(set title = A square
subsection Scene
  set symmetry = none
  set end time = 1000
  subsection Domain
    set shape = box
    set dimension = 2
    set lower corner = -1, -1
    set upper corner = 1, 1
  end
  subsection Material
    set latent heat = 333500
    set melting temperature = 0
    subsection Solid
      set conductivity = 2.2
      set specific heat capacity = 2090
      set density = 1000
    end
  end
  subsection Initial state
    set temperature = 10
  end
  subsection Source 1
    set position = 0, 0
    set power = -100
  end
end
)";

  /** A complete case: ice on the inner wall of an annulus, with a front of its own. */
  inline const std::string annulus = R"(set title = An annulus
subsection Scene
  set symmetry = none
  set end time = 0.2
  subsection Domain
    set shape = shell
    set dimension = 2
    set radius = 1
    set inner radius = 0.2
  end
  subsection Material
    set latent heat = 1
    set melting temperature = 0
    subsection Solid
      set conductivity = 1
      set specific heat capacity = 1
      set density = 1
    end
  end
  subsection Initial state
    set temperature = if(x^2 + y^2 < 0.25, -1, 1)*abs(x^2 + y^2 - 0.25)
    set front = x^2 + y^2 - 0.25
  end
  subsection Walls
    subsection inner
      set kind = fixed temperature
      set temperature = -0.21
    end
    subsection outer
      set kind = insulated
    end
  end
end
)";

  /** A text with its one occurrence of a piece replaced. */
  inline std::string replaced(std::string text, const std::string &old_piece,
                              const std::string &new_piece)
  {
    const std::size_t at = text.find(old_piece);
    if(at == std::string::npos || text.find(old_piece, at + 1) != std::string::npos)
      throw std::logic_error("'" + old_piece + "' does not occur once");
    return text.replace(at, old_piece.size(), new_piece);
  }

  /** A case's text with something appended. */
  inline std::string with(const std::string &text, const std::string &more)
  {
    return text + more;
  }

  inline Case read(const std::string &text)
  {
    return read_case_text(text, "a.prm");
  }

  /** The message of the InputError that a text raises. */
  inline std::string complaint(const std::string &text)
  {
    try
    {
      read(text);
    }
    catch(const InputError &error)
    {
      return error.what();
    }
    return "no complaint";
  }
} // namespace meltfront::cases::test

#endif
