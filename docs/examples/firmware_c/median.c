#include "median.h"

#include <stdlib.h>

static int in_order(const void *a, const void *b)
{
    double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

double median(double *values, long count)
{
    if (count == 0)
        return 0.0;
    qsort(values, (size_t)count, sizeof *values, in_order);
    return (values[(count - 1) / 2] + values[count / 2]) / 2.0;
}
