#include <verification/matrix/criterion_record.h>
#include <verification/matrix/json_values.h>

namespace meltfront::verification
{
  namespace
  {
    const char *name_of(cases::Statistic statistic)
    {
      switch(statistic)
      {
      case cases::Statistic::value:
        return "value";
      case cases::Statistic::median:
        return "median";
      case cases::Statistic::order:
        return "order";
      case cases::Statistic::failure:
        return "failure";
      default:
        return "worst";
      }
    }

    cases::Statistic statistic_named(const std::string &name)
    {
      for(const cases::Statistic statistic :
          {cases::Statistic::value, cases::Statistic::median, cases::Statistic::order,
           cases::Statistic::failure})
        if(name == name_of(statistic))
          return statistic;
      return cases::Statistic::worst;
    }
  } // namespace

  nlohmann::json json_of(const cases::Criterion &c)
  {
    return {{"text", c.text},
            {"method", c.method},
            {"quantity", c.quantity},
            {"statistic", name_of(c.statistic)},
            {"n", c.n},
            {"n_from", c.n_from},
            {"n_to", c.n_to},
            {"lower", json_of(c.lower)},
            {"upper", json_of(c.upper)},
            {"known_shortfall", c.known_shortfall}};
  }

  cases::Criterion criterion_in(const nlohmann::json &json)
  {
    cases::Criterion criterion;
    criterion.text = json.at("text");
    criterion.method = json.at("method");
    criterion.quantity = json.at("quantity");
    criterion.statistic = statistic_named(json.at("statistic"));
    criterion.n = json.at("n");
    criterion.n_from = json.at("n_from");
    criterion.n_to = json.at("n_to");
    criterion.lower = number_in(json.at("lower"));
    criterion.upper = number_in(json.at("upper"));
    criterion.known_shortfall = json.at("known_shortfall");
    return criterion;
  }
} // namespace meltfront::verification
