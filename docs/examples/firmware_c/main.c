/* A profiler's firmware under test: section 5.7 in time, its backward pass over distance. */
#include <stddef.h>

#include "protocol.h"
#include "run.h"

int main(void)
{
    struct device device = {"firmware_c", "1.0", "temporal", run, NULL};
    return serve(&device);
}
