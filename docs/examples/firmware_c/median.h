#ifndef MEDIAN_H
#define MEDIAN_H

/* The median of numbers that are not NaN, which it sorts; 0 if there is no number. */
double median(double *values, long count);

#endif
