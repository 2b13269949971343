#include "json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DEEPEST = 64, LONGEST_KEY = 64 };

static const char *skip_space(const char *p, const char *end)
{
    while (p < end && (*p == ' ' || *p == '\t' || *p == '\n' || *p == '\r'))
        p++;
    return p;
}

static int hex_digit(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* The code of four hexadecimal digits, -1 if they are not hexadecimal. */
static long hex_code(const char *p, const char *end)
{
    long code = 0;
    if (end - p < 4)
        return -1;
    for (int i = 0; i < 4; i++) {
        int digit = hex_digit(p[i]);
        if (digit < 0)
            return -1;
        code = 16 * code + digit;
    }
    return code;
}

/* Each of these returns the end of the value, NULL if it is not one. */
static const char *skip_string(const char *p, const char *end)
{
    for (p++; p < end && *p != '"'; p++) {
        if ((unsigned char)*p < 0x20)
            return NULL;
        if (*p != '\\')
            continue;
        if (++p >= end)
            return NULL;
        if (*p == 'u' ? hex_code(p + 1, end) < 0 : !memchr("\"\\/bfnrt", *p, 8))
            return NULL;
    }
    return p < end ? p + 1 : NULL;
}

static const char *skip_digits(const char *p, const char *end)
{
    const char *first = p;
    while (p < end && *p >= '0' && *p <= '9')
        p++;
    return p > first ? p : NULL;
}

static const char *skip_number(const char *p, const char *end)
{
    if (p < end && *p == '-')
        p++;
    if (p < end && *p == '0')
        p++;
    else if ((p = skip_digits(p, end)) == NULL)
        return NULL;
    if (p < end && *p == '.' && (p = skip_digits(p + 1, end)) == NULL)
        return NULL;
    if (p < end && (*p == 'e' || *p == 'E')) {
        p++;
        if (p < end && (*p == '+' || *p == '-'))
            p++;
        p = skip_digits(p, end);
    }
    return p;
}

static const char *skip_word(const char *p, const char *end)
{
    static const char *const words[] = {"true", "false", "null"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        size_t length = strlen(words[i]);
        if ((size_t)(end - p) >= length && memcmp(p, words[i], length) == 0)
            return p + length;
    }
    return NULL;
}

static const char *skip_value(const char *p, const char *end, int depth);

/* One member of an object, or one item of an array. */
static const char *skip_entry(const char *p, const char *end, int depth, bool keyed)
{
    if (keyed) {
        if (p >= end || *p != '"' || (p = skip_string(p, end)) == NULL)
            return NULL;
        p = skip_space(p, end);
        if (p >= end || *p != ':')
            return NULL;
        p = skip_space(p + 1, end);
    }
    p = skip_value(p, end, depth + 1);
    return p == NULL ? NULL : skip_space(p, end);
}

static const char *skip_group(const char *p, const char *end, int depth)
{
    bool keyed = *p == '{';
    char close = keyed ? '}' : ']';
    p = skip_space(p + 1, end);
    if (p < end && *p == close)
        return p + 1;
    while ((p = skip_entry(p, end, depth, keyed)) != NULL && p < end) {
        if (*p == close)
            return p + 1;
        if (*p != ',')
            return NULL;
        p = skip_space(p + 1, end);
    }
    return NULL;
}

static const char *skip_value(const char *p, const char *end, int depth)
{
    if (p >= end || depth > DEEPEST)
        return NULL;
    if (*p == '{' || *p == '[')
        return skip_group(p, end, depth);
    if (*p == '"')
        return skip_string(p, end);
    if (*p == '-' || (*p >= '0' && *p <= '9'))
        return skip_number(p, end);
    return skip_word(p, end);
}

bool json_parse(const char *text, size_t length, struct json *value)
{
    const char *end = text + length;
    if (length >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0)
        text += 3;
    value->begin = skip_space(text, end);
    value->end = skip_value(value->begin, end, 0);
    return value->end != NULL && skip_space(value->end, end) == end;
}

bool json_is_array(struct json value)
{
    return *value.begin == '[';
}

bool json_is_object(struct json value)
{
    return *value.begin == '{';
}

bool json_item(struct json array, struct json *item)
{
    const char *p = item->begin == NULL ? array.begin + 1 : skip_space(item->end, array.end);
    if (!json_is_array(array))
        return false;
    if (item->begin != NULL && *p == ',')
        p++;
    p = skip_space(p, array.end);
    if (*p == ']')
        return false;
    item->begin = p;
    item->end = skip_value(p, array.end, 0);
    return item->end != NULL;
}

bool json_member(struct json object, const char *key, struct json *value)
{
    bool found = false;
    const char *p = skip_space(object.begin + 1, object.end);
    if (!json_is_object(object))
        return false;
    while (*p == '"') {
        char name[LONGEST_KEY];
        struct json text = {p, skip_string(p, object.end)};
        bool same = json_text(text, name, sizeof name) && strcmp(name, key) == 0;
        p = skip_space(skip_space(text.end, object.end) + 1, object.end);
        text.begin = p;
        text.end = skip_value(p, object.end, 0);
        if (same)
            *value = text;
        found = found || same;
        p = skip_space(text.end, object.end);
        if (*p == ',')
            p = skip_space(p + 1, object.end);
    }
    return found;
}

bool json_number(struct json value, double *number)
{
    if (*value.begin != '-' && (*value.begin < '0' || *value.begin > '9'))
        return false;
    *number = strtod(value.begin, NULL);
    return isfinite(*number);
}
