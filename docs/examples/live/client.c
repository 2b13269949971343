/* Sends a table of samples to `floatref live`, and prints the final points.

       cc -std=c99 -o client client.c && ./client PORT TABLE.csv RATE_HZ

   A row of the table is: specific force in m/s2, height in m, distance in m. Samples are numbered, so
   that a run which was killed is completed by the same call: what the command has is left out. */

#define _POSIX_C_SOURCE 200809L
#include <arpa/inet.h>
#include <netinet/in.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

enum { AT_ONCE = 100, CHANNELS = 3 };
static const char *const NAMES[CHANNELS] = {"left.vertical_specific_force", "left.height",
                                            "distance"};

static int connect_to(int port)
{
    struct sockaddr_in place = {0};
    const int peer = socket(AF_INET, SOCK_STREAM, 0);
    place.sin_family = AF_INET;
    place.sin_port = htons((unsigned short)port);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (peer < 0 || connect(peer, (struct sockaddr *)&place, sizeof place) != 0) {
        perror("connect");
        exit(1);
    }
    return peer;
}

static void send_hello(FILE *out, const char *rate_hz)
{
    fprintf(out,
            "{\"kind\": \"hello\", \"format\": \"floatref-live/1\", "
            "\"pipeline\": \"temporal-matched-hpf\", \"setup\": {\"profile_interval_m\": 0.1}, "
            "\"channels\": ["
            "{\"name\": \"vertical_specific_force\", \"track\": \"left\", "
            "\"unit\": \"m/s\xc2\xb2\", \"rate_hz\": %s}, "
            "{\"name\": \"height\", \"track\": \"left\", \"unit\": \"m\", \"rate_hz\": %s}, "
            "{\"name\": \"distance\", \"unit\": \"m\", \"rate_hz\": %s}]}\n",
            rate_hz, rate_hz, rate_hz);
}

static void send_samples(FILE *out, double rows[][CHANNELS], int count, long first)
{
    fputs("{\"kind\": \"samples\", \"channels\": {", out);
    for (int c = 0; c < CHANNELS; c++) {
        fprintf(out, "%s\"%s\": {\"first\": %ld, \"values\": [", c ? ", " : "", NAMES[c], first);
        for (int k = 0; k < count; k++)
            fprintf(out, "%s%.17g", k ? ", " : "", rows[k][c]);
        fputs("]}", out);
    }
    fputs("}}\n", out);
    fflush(out); /* A logger sends each piece when it is measured. */
}

static int print_answers(FILE *in)
{
    char *line = NULL;
    size_t size = 0;
    int code = 1;
    while (getline(&line, &size, in) > 0) {
        if (strstr(line, "{\"kind\": \"points\"") && strstr(line, "\"state\": \"final\""))
            fputs(line, stdout);
        if (strstr(line, "{\"kind\": \"refused\""))
            fputs(line, stderr);
        if (strstr(line, "{\"kind\": \"finished\""))
            code = 0;
    }
    free(line);
    return code;
}

int main(int argc, char **argv)
{
    static double rows[AT_ONCE][CHANNELS];
    FILE *table = argc == 4 ? fopen(argv[2], "r") : NULL;
    if (table == NULL) {
        fputs("usage: client PORT TABLE.csv RATE_HZ\n", stderr);
        return 2;
    }
    const int peer = connect_to(atoi(argv[1]));
    FILE *out = fdopen(dup(peer), "w"), *in = fdopen(peer, "r");
    int count = 0;
    long first = 0;
    send_hello(out, argv[3]);
    while (fscanf(table, "%lf,%lf,%lf", &rows[count][0], &rows[count][1], &rows[count][2]) == 3)
        if (++count == AT_ONCE) {
            send_samples(out, rows, count, first);
            first += count;
            count = 0;
        }
    if (count)
        send_samples(out, rows, count, first);
    fputs("{\"kind\": \"finish\"}\n", out);
    fclose(out);
    fclose(table);
    return print_answers(in);
}
