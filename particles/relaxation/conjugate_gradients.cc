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
    constexpr double growth = 4; ///< of the first trial over the last step

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
        gradient = trial = trial_gradient = direction = x;
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
        while(!result.converged && result.iterations < parameters.most_iterations)
        {
          const double before = energy;
          if(!iterate())
            result.converged = true; // nothing descends any more: round-off
          else
          {
            ++result.iterations;
            result.converged
                = std::abs(energy - before) <= parameters.tolerance * std::abs(energy);
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

      /** One line search. @return whether the energy fell or stayed, at another place */
      bool iterate()
      {
        double slope = age > 0 ? turn() : start_anew();
        if(slope >= 0)
          slope = start_anew();
        if(slope == 0)
          return false;
        if(search())
          return true;
        if(age == 0)
          return false;
        start_anew();
        return search();
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

      bool search()
      {
        double step = parameters.longest_step / largest(direction);
        if(last_step > 0 && age > 0)
          step = std::min(step, growth * last_step);
        for(int halving = 0; halving < most_halvings; ++halving, step *= 0.5)
        {
          const double expected = move(step);
          if(expected == 0)
            return false;
          const double found = evaluate(trial, trial_gradient);
          // Not true either where the energy is not a number.
          if(found <= energy + armijo * expected)
          {
            accept(found, step);
            return true;
          }
        }
        return false;
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

      /** Largest length of a particle's vector. */
      double largest(const Coordinates &vectors) const
      {
        double result = 0;
        for(std::size_t i = 0; i < vectors[0].size(); ++i)
        {
          double length = 0;
          for(int d = 0; d < box.dimension; ++d)
            length += vectors[d][i] * vectors[d][i];
          result = std::max(result, length);
        }
        return std::sqrt(result);
      }

      const EnergyFunction &function;
      Coordinates &x;
      CoordinateBox box;
      DescentParameters parameters;
      Coordinates gradient, trial, trial_gradient, direction;
      double energy = 0;
      double polak_ribiere = 0;
      double last_step = 0;
      std::size_t age = 0; ///< iterations since the last restart
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
