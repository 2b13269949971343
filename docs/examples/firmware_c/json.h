/* JSON, read in place: a value is a stretch of the text, nothing is copied or allocated. */
#ifndef JSON_H
#define JSON_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

struct json {
    const char *begin, *end;
};

/* Check the whole text, which ends with '\0' behind `length`; false if it is not one JSON value. */
bool json_parse(const char *text, size_t length, struct json *value);

/* Member `key` of an object, the last one if it is repeated; false if it is missing. */
bool json_member(struct json object, const char *key, struct json *value);

/* Next item of an array; the first one if item->begin is NULL; false behind the last. */
bool json_item(struct json array, struct json *item);

/* A finite number; false if the value is anything else. */
bool json_number(struct json value, double *number);

/* A string as UTF-8 with '\0' at its end; false if it is no string, does not fit or holds a '\0'. */
bool json_text(struct json value, char *text, size_t size);

bool json_is_array(struct json value);
bool json_is_object(struct json value);

/* Write a string in quotes; bytes beyond ASCII are passed on as UTF-8. */
void json_write_text(FILE *stream, const char *text);

#endif
