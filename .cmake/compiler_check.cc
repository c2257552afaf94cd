// What g++ 12.2 miscompiles at -O3 with AVX-512: the last two of `f` come out as 0.5.
// Exits with 0 if they are right.
#include <array>
#include <vector>

struct Sites
{
  std::vector<double> w, t, f;
  std::array<std::vector<double>, 2> c;
};

__attribute__((noinline)) Sites sites()
{
  Sites s;
  s.w = {0.25, 0.25, 0.25, 0.25};
  s.t = {-0.375, -0.125, 0.125, 0.375};
  s.f = {0.5, 0.5, 0, 0};
  s.c[0] = {0.1, 0.1, 0.1, 0.1};
  return s;
}

int main()
{
  const Sites s = sites();
  return s.f[0] == 0.5 && s.f[1] == 0.5 && s.f[2] == 0 && s.f[3] == 0 ? 0 : 1;
}
