// A plugin whose method does nothing, or that goes wrong as the environment says.
#include <cases/error.h>
#include <cases/plugin.h>
#include <cases/run.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace
{
  using namespace meltfront::cases;

  class Idle : public Method
  {
  public:
    explicit Idle(const std::string &name)
      : Method(name, "Takes nothing.")
    {
    }

    std::vector<Capabilities> capabilities() const override
    {
      return {};
    }

    std::vector<OptionDeclaration> option_declarations() const override
    {
      return {};
    }

  protected:
    std::unique_ptr<Run> set_up(const Scene &, const EffectSet &,
                                const Resolution &) const override
    {
      return nullptr;
    }
  };

  std::vector<std::unique_ptr<Method>> methods()
  {
    const char *asked = std::getenv("MELTFRONT_WRONG_PLUGIN");
    const std::string wrong = asked ? asked : "";
    if(wrong == "throws")
      throw std::runtime_error("its licence has run out");
    if(wrong == "throws a number")
      throw 7;
    std::vector<std::unique_ptr<Method>> list;
    if(wrong == "nothing")
      return list;
    list.push_back(std::make_unique<Idle>(wrong.empty() ? "idle" : wrong));
    if(wrong == "twice")
      list.push_back(std::make_unique<Idle>("twice"));
    return list;
  }
} // namespace

MELTFRONT_PLUGIN(methods)
