// Exits with 0 if this processor has all that x86-64-v3 needs.
int main()
{
  __builtin_cpu_init();
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")
                 && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2")
             ? 0
             : 1;
}
