#include "setup.h"

/* Of the system vehicle of Karamihas (2021), section 4.2; ahead of the accelerometers. */
static const double USUAL_WHEELBASE_M = 3.43, USUAL_FRONT_M = 4.63, FARTHEST_M = 100.0;

/* Member `key` of an object; nothing of what is not there. */
static struct json inside(struct json object, const char *key)
{
    struct json value = {NULL, NULL};
    if (object.begin == NULL || !json_is_object(object) || !json_member(object, key, &value))
        return (struct json){NULL, NULL};
    return value;
}

/* A place within 100 m, if it is stated. */
static bool read_place(struct json value, const char *what, double *place_m, struct failure *failure)
{
    if (value.begin == NULL)
        return true;
    if (json_number(value, place_m) && *place_m >= -FARTHEST_M && *place_m <= FARTHEST_M)
        return true;
    return fail(failure, "setup: %s is not a number within %g m", what, FARTHEST_M);
}

/* The first of the coordinates of an offset: ahead. */
static bool read_ahead(struct json offset, const char *what, double *ahead_m,
                       struct failure *failure)
{
    struct json first = {NULL, NULL};
    if (offset.begin == NULL)
        return true;
    if (!json_is_array(offset) || !json_item(offset, &first))
        return fail(failure, "setup: %s is not a list of three numbers", what);
    return read_place(first, what, ahead_m, failure);
}

bool setup_read(struct recording *recording, struct json document, struct failure *failure)
{
    struct json setup = inside(document, "setup"), axles = inside(setup, "axles");
    for (int i = 0; i < recording->tracks; i++) {
        struct json track = inside(inside(setup, "tracks"), recording->track[i]);
        if (!read_ahead(inside(track, "reference_point_m"), "reference_point_m",
                        &recording->reference_m[i], failure) ||
            !read_ahead(inside(track, "laser_offset_m"), "laser_offset_m", &recording->lever_m[i],
                        failure))
            return false;
    }
    recording->wheelbase_m = USUAL_WHEELBASE_M;
    recording->front_axle_m = recording->reference_m[0] + USUAL_FRONT_M;
    return read_place(inside(axles, "wheelbase_m"), "wheelbase_m", &recording->wheelbase_m, failure) &&
           read_place(inside(axles, "front_axle_m"), "front_axle_m", &recording->front_axle_m, failure);
}

void place_vehicle(struct vehicle *vehicle, const struct recording *recording)
{
    double reference_m = 0.0, share = 1.0 / (double)recording->tracks;
    vehicle->paths = recording->tracks;
    for (int i = 0; i < recording->tracks; i++) {
        reference_m += share * recording->reference_m[i];
        vehicle->lever_m += share * recording->lever_m[i];
        vehicle->on_levers = vehicle->on_levers || recording->lever_m[i] != 0.0;
    }
    vehicle->front_m = recording->front_axle_m - reference_m - vehicle->lever_m;
    vehicle->rear_m = vehicle->front_m - recording->wheelbase_m;
}
