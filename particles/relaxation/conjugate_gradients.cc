#include <cases/error.h>
#include <particles/relaxation/conjugate_gradients.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meltfront::particles
{
  namespace
  {
    constexpr double armijo = 1e-4;
    constexpr int most_halvings = 60;
    constexpr double growth = 4;      ///< of the first trial over the last step
    constexpr double overshoot = 0.3; ///< slope behind the trial over that before it
    constexpr double recovery = 1.2; ///< of the limit on single particles after a success
    constexpr double least_limit = 1e-3; ///< of it over the longest step
    constexpr double few = 0.01;         ///< particles that may still be pushed strongly

    /** The state of a descent; sums run in the order of the coordinates. */
    class Descender
    {
    public:
      Descender(const EnergyFunction &function, Coordinates &x, const CoordinateBox &box,
                const DescentParameters &parameters)
        : function(function)
        , x(x)
        , box(box)
        , parameters(parameters)
      {
        for(int d = 0; d < box.dimension; ++d)
          for(double &coordinate : x[d])
            coordinate = std::clamp(coordinate, box.lower[d], box.upper[d]);
        gradient = trial = trial_gradient = spare = spare_gradient = direction = x;
        for(int d = 0; d < box.dimension; ++d)
          std::ranges::fill(direction[d], 0.);
        energy = evaluate(x, gradient);
      }

      Descent run()
      {
        Descent result;
        result.energy_before = energy;
        if(!std::isfinite(energy))
          throw cases::NumericalError("relaxation", 0, 0, "the energy",
                                      "is not finite: particles coincide");
        spread(result);
        double window_start = energy;
        long window_end = result.iterations + descent_window;
        while(!result.converged && result.iterations < parameters.most_iterations)
        {
          const double before = energy;
          if(!iterate())
          {
            result.converged = true; // nothing descends any more: round-off
            break;
          }
          ++result.iterations;
          result.converged
              = std::abs(energy - before) <= parameters.tolerance * std::abs(energy);
          if(result.iterations == window_end)
          {
            result.converged |= window_start - energy < parameters.least_fall;
            window_start = energy;
            window_end += descent_window;
          }
        }
        result.energy = energy;
        result.largest_force = largest(gradient);
        result.evaluations = evaluations;
        return result;
      }

    private:
      /** Energy at a place, and its gradient without what the walls bear. */
      double evaluate(const Coordinates &place, Coordinates &result)
      {
        ++evaluations;
        const double value = function(place, result);
        for(int d = 0; d < box.dimension; ++d)
          for(std::size_t i = 0; i < place[d].size(); ++i)
            if((place[d][i] <= box.lower[d] && result[d][i] > 0)
               || (place[d][i] >= box.upper[d] && result[d][i] < 0))
              result[d][i] = 0;
        return value;
      }

      /** Move particles along their own forces while many are pushed strongly. */
      void spread(Descent &result)
      {
        double limit = parameters.stiffness > 0 ? parameters.longest_step : 0;
        while(limit > least_limit * parameters.longest_step
              && result.iterations < parameters.most_iterations && many_pushed())
        {
          const double expected = move_apart(limit);
          const double found = evaluate(trial, trial_gradient);
          if(found <= energy + armijo * expected)
          {
            std::swap(x, trial);
            std::swap(gradient, trial_gradient);
            energy = found;
            ++result.iterations;
            limit = std::min(recovery * limit, parameters.longest_step);
          }
          else
            limit *= 0.5;
        }
      }

      /** Whether forces would move many particles by more than the longest step. */
      bool many_pushed() const
      {
        const double bearable = parameters.stiffness * parameters.longest_step;
        std::size_t pushed = 0;
        for(std::size_t i = 0; i < x[0].size(); ++i)
          pushed += squared_length(gradient, i) > bearable * bearable;
        return static_cast<double>(pushed) > few * static_cast<double>(x[0].size());
      }

      /** Set the trial place, each particle moved by at most a limit.
       * @return g . (trial - x) */
      double move_apart(double limit)
      {
        double expected = 0;
        for(std::size_t i = 0; i < x[0].size(); ++i)
        {
          const double force = std::sqrt(squared_length(gradient, i));
          const double step = 1 / std::max(parameters.stiffness, force / limit);
          for(int d = 0; d < box.dimension; ++d)
          {
            trial[d][i]
                = std::clamp(x[d][i] - step * gradient[d][i], box.lower[d], box.upper[d]);
            expected += gradient[d][i] * (trial[d][i] - x[d][i]);
          }
        }
        return expected;
      }

      /** One line search. @return whether the energy fell or stayed, at another place */
      bool iterate()
      {
        double slope = age > 0 ? turn() : start_anew();
        if(slope >= 0)
          slope = start_anew();
        if(slope == 0)
          return false;
        if(search(slope))
          return true;
        if(age == 0)
          return false;
        slope = start_anew();
        return slope < 0 && search(slope);
      }

      /** The direction after one step at least. @return g . d */
      double turn()
      {
        const double beta = std::max(0., polak_ribiere);
        double slope = 0;
        for(int d = 0; d < box.dimension; ++d)
          for(std::size_t i = 0; i < x[d].size(); ++i)
          {
            double component = beta * direction[d][i] - gradient[d][i];
            // Into a wall on which the particle lies it would only be clamped.
            if((x[d][i] <= box.lower[d] && component < 0)
               || (x[d][i] >= box.upper[d] && component > 0))
              component = 0;
            direction[d][i] = component;
            slope += gradient[d][i] * component;
          }
        return slope;
      }

      double start_anew()
      {
        age = 0;
        double squared = 0; // |g|^2
        for(int d = 0; d < box.dimension; ++d)
          for(std::size_t i = 0; i < x[d].size(); ++i)
          {
            direction[d][i] = -gradient[d][i];
            squared += gradient[d][i] * gradient[d][i];
          }
        return -squared;
      }

      /** @param slope g . d, along which the energy falls */
      bool search(double slope)
      {
        double step = first_trial(slope);
        for(int halving = 0; halving < most_halvings; ++halving, step *= 0.5)
        {
          const double expected = move(step);
          if(expected == 0)
            return false;
          const double found = evaluate(trial, trial_gradient);
          // Not true either where the energy is not a number.
          if(found <= energy + armijo * expected)
          {
            const double behind = product(trial_gradient, direction);
            const double secant = slope / (slope - behind);
            last_slope = slope;
            next_growth = behind > slope ? std::clamp(secant, 0.5, growth) : growth;
            if(behind > -overshoot * slope)
              shorten(found, step, secant);
            else
              accept(found, step);
            return true;
          }
        }
        return false;
      }

      /** The last step, corrected by the slopes along it, where the new slope puts it. */
      double first_trial(double slope) const
      {
        const double longest = parameters.longest_step / largest(direction);
        if(last_step == 0 || age == 0)
          return longest;
        const double scale = next_growth * last_slope / slope;
        return std::min(longest, last_step * std::clamp(scale, 0.1, growth));
      }

      /** The trial went far beyond the minimum along the direction: try where the slope
       * would vanish if it was linear, and accept the lower of both. */
      void shorten(double found, double step, double secant)
      {
        std::swap(trial, spare);
        std::swap(trial_gradient, spare_gradient);
        const double expected = move(secant * step);
        const double nearer = evaluate(trial, trial_gradient);
        if(nearer <= std::min(found, energy + armijo * expected))
        {
          next_growth = 1;
          accept(nearer, secant * step);
          return;
        }
        std::swap(trial, spare);
        std::swap(trial_gradient, spare_gradient);
        accept(found, step);
      }

      /** Set the trial place. @return g . (trial - x) */
      double move(double step)
      {
        double expected = 0;
        for(int d = 0; d < box.dimension; ++d)
          for(std::size_t i = 0; i < x[d].size(); ++i)
          {
            trial[d][i] = std::clamp(x[d][i] + step * direction[d][i], box.lower[d],
                                     box.upper[d]);
            expected += gradient[d][i] * (trial[d][i] - x[d][i]);
          }
        return std::min(expected, 0.);
      }

      void accept(double found, double step)
      {
        double product = 0, previous = 0;
        for(int d = 0; d < box.dimension; ++d)
          for(std::size_t i = 0; i < x[d].size(); ++i)
          {
            product += trial_gradient[d][i] * (trial_gradient[d][i] - gradient[d][i]);
            previous += gradient[d][i] * gradient[d][i];
          }
        polak_ribiere = previous > 0 ? product / previous : 0;
        std::swap(x, trial);
        std::swap(gradient, trial_gradient);
        energy = found;
        last_step = step;
        ++age;
        if(age >= box.dimension * x[0].size())
          age = 0;
      }

      double squared_length(const Coordinates &vectors, std::size_t i) const
      {
        double result = 0;
        for(int d = 0; d < box.dimension; ++d)
          result += vectors[d][i] * vectors[d][i];
        return result;
      }

      /** Largest length of a particle's vector. */
      double largest(const Coordinates &vectors) const
      {
        double result = 0;
        for(std::size_t i = 0; i < vectors[0].size(); ++i)
          result = std::max(result, squared_length(vectors, i));
        return std::sqrt(result);
      }

      double product(const Coordinates &a, const Coordinates &b) const
      {
        double sum = 0;
        for(int d = 0; d < box.dimension; ++d)
          for(std::size_t i = 0; i < a[d].size(); ++i)
            sum += a[d][i] * b[d][i];
        return sum;
      }

      const EnergyFunction &function;
      Coordinates &x;
      CoordinateBox box;
      DescentParameters parameters;
      Coordinates gradient, trial, trial_gradient, direction;
      Coordinates spare, spare_gradient; ///< a trial that may still be accepted
      double energy = 0;
      double polak_ribiere = 0;
      double last_step = 0, last_slope = 0;
      double next_growth = 1; ///< of the step that the last slopes call for
      std::size_t age = 0;    ///< iterations since the last restart
      long evaluations = 0;
    };
  } // namespace

  Descent conjugate_gradients(const EnergyFunction &energy, Coordinates &coordinates,
                              const CoordinateBox &box,
                              const DescentParameters &parameters)
  {
    return Descender(energy, coordinates, box, parameters).run();
  }
} // namespace meltfront::particles
