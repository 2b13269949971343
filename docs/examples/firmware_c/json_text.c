/* Strings of JSON: out of their escapes, and back. */
#include "json.h"

#include <stdlib.h>
#include <string.h>

struct output {
    char *at, *end;
    bool full;
};

static void put(struct output *out, unsigned long byte)
{
    if (out->at < out->end)
        *out->at++ = (char)byte;
    else
        out->full = true;
}

/* Write `code` as UTF-8. */
static void put_code(struct output *out, unsigned long code)
{
    if (code < 0x80) {
        put(out, code);
    } else if (code < 0x800) {
        put(out, 0xC0 | code >> 6);
        put(out, 0x80 | (code & 0x3F));
    } else if (code < 0x10000) {
        put(out, 0xE0 | code >> 12);
        put(out, 0x80 | (code >> 6 & 0x3F));
        put(out, 0x80 | (code & 0x3F));
    } else {
        put(out, 0xF0 | code >> 18);
        put(out, 0x80 | (code >> 12 & 0x3F));
        put(out, 0x80 | (code >> 6 & 0x3F));
        put(out, 0x80 | (code & 0x3F));
    }
}

static unsigned long unit_at(const char *p)
{
    char digits[5] = {p[0], p[1], p[2], p[3], '\0'};
    return strtoul(digits, NULL, 16);
}

/* Write the character of `\uXXXX`, or of two of them, at `p`; return where they end. */
static const char *put_unit(struct output *out, const char *p, const char *end)
{
    unsigned long code = unit_at(p + 2);
    p += 6;
    if (code >= 0xD800 && code < 0xDC00 && end - p >= 6 && p[0] == '\\' && p[1] == 'u') {
        unsigned long low = unit_at(p + 2);
        if (low >= 0xDC00 && low < 0xE000) {
            code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
            p += 6;
        }
    }
    if (code == 0 || (code >= 0xD800 && code < 0xE000))
        out->full = true;
    put_code(out, code);
    return p;
}

static char unescaped(char c)
{
    const char *found = strchr("b\bf\fn\nr\rt\t", c);
    return found == NULL ? c : found[1];
}

bool json_text(struct json value, char *text, size_t size)
{
    struct output out = {text, text + size - 1, false};
    const char *p = value.begin + 1, *end = value.end - 1;
    if (*value.begin != '"')
        return false;
    while (p < end) {
        if (*p != '\\') {
            put(&out, (unsigned char)*p++);
        } else if (p[1] == 'u') {
            p = put_unit(&out, p, end);
        } else {
            put(&out, (unsigned char)unescaped(p[1]));
            p += 2;
        }
    }
    *out.at = '\0';
    return !out.full;
}

void json_write_text(FILE *stream, const char *text)
{
    fputc('"', stream);
    for (; *text != '\0'; text++) {
        unsigned char c = (unsigned char)*text;
        if (c < 0x20)
            fprintf(stream, "\\u%04x", (unsigned)c);
        else if (c == '"' || c == '\\')
            fprintf(stream, "\\%c", c);
        else
            fputc(c, stream);
    }
    fputc('"', stream);
}
