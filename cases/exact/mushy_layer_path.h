#ifndef meltfront_cases_exact_mushy_layer_path_h
#define meltfront_cases_exact_mushy_layer_path_h

#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace meltfront::cases::similarity
{
  /**
   * A solution of ordinary differential equations whose first unknown falls along it, so
   * that the others can be asked for at any value of it.
   *
   * States are kept at steps of a method of order 8 (Fehlberg 1968); in between, one
   * shorter step is taken from the state before. The equations must be smooth within a
   * step: begin a new one where they are not.
   */
  template <typename Real, std::size_t n>
  class Path
  {
  public:
    using State = std::array<Real, n>;
    using Rates = std::function<void(const State &, State &, const Real &)>;

    struct Place
    {
      Real parameter;
      State state;
    };

    Path(Rates rates, const Real &parameter, const State &state)
      : rates(std::move(rates))
      , places{{parameter, state}}
    {
    }

    const Place &first() const
    {
      return places.front();
    }
    const Place &last() const
    {
      return places.back();
    }

    /** Go on by a step of the parameter. */
    void advance(const Real &step)
    {
      places.push_back(stepped(places.back(), step));
    }

    /**
     * Go on by a step of the parameter, or to where a function of the place, positive
     * here, has fallen to zero within it.
     * @return whether it has
     */
    template <typename Function>
    bool advance_to_zero(const Real &step, const Function &function)
    {
      const Place from = places.back();
      Place to = stepped(from, step);
      const bool reached = !(function(to) > 0);
      if(reached)
      {
        Real before = 0, after = 1;
        for(int i = 0; i < std::numeric_limits<Real>::digits; ++i)
        {
          const Real share = (before + after) / 2;
          to = stepped(from, share * step);
          (function(to) > 0 ? before : after) = share;
        }
      }
      places.push_back(to);
      return reached;
    }

    /** The place at which the first unknown has a value, between its first and its last.
     */
    Place at(const Real &value) const
    {
      using std::abs;
      if(places.size() == 1)
        return places.front();
      const auto after = std::lower_bound(places.begin() + 1, places.end() - 1, value,
                                          [](const Place &place, const Real &v)
                                          { return place.state[0] > v; });
      const Place &from = *(after - 1);
      const Real whole = after->parameter - from.parameter;
      Real step = whole * (from.state[0] - value) / (from.state[0] - after->state[0]);
      Place found = stepped(from, step);
      // Newton's method, until its steps no longer shrink: round-off.
      Real last_change = abs(whole);
      for(;;)
      {
        State rate;
        rates(found.state, rate, found.parameter);
        const Real change = (value - found.state[0]) / rate[0];
        if(!(2 * abs(change) < last_change))
          return found;
        last_change = abs(change);
        step += change;
        found = stepped(from, step);
      }
    }

  private:
    Place stepped(const Place &from, const Real &step) const
    {
      boost::numeric::odeint::runge_kutta_fehlberg78<State, Real, State, Real> method;
      Place to{from.parameter + step, from.state};
      if(step != 0)
        method.do_step(rates, to.state, from.parameter, step);
      return to;
    }

    Rates rates;
    std::vector<Place> places;
  };
} // namespace meltfront::cases::similarity

#endif
