#!/usr/bin/env bash
# Sends a table of samples to `floatref live`, and prints the final points.
#
#     bash client.sh PORT TABLE.csv RATE_HZ
#
# A row of the table is: specific force in m/s2, height in m, distance in m. Samples are numbered, so
# that a run which was killed is completed by the same call: what the command has is left out.
set -euo pipefail
port=$1 table=$2 rate=$3

hello() {
    printf '{"kind": "hello", "format": "floatref-live/1", "pipeline": "temporal-matched-hpf", '
    printf '"setup": {"profile_interval_m": 0.1}, "channels": ['
    printf '{"name": "vertical_specific_force", "track": "left", "unit": "m/s²", "rate_hz": %s}, ' "$rate"
    printf '{"name": "height", "track": "left", "unit": "m", "rate_hz": %s}, ' "$rate"
    printf '{"name": "distance", "unit": "m", "rate_hz": %s}]}\n' "$rate"
}

samples() {
    awk -F, '
        function piece(name, values) {
            return "\"" name "\": {\"first\": " first + 0 ", \"values\": [" values "]}"
        }
        function send() {
            print "{\"kind\": \"samples\", \"channels\": {" \
                piece("left.vertical_specific_force", force) ", " \
                piece("left.height", height) ", " piece("distance", distance) "}}"
            first += count; count = 0; force = height = distance = ""
        }
        {
            comma = count ? ", " : ""
            force = force comma $1; height = height comma $2; distance = distance comma $3
            if (++count == 100) send()
        }
        END { if (count) send() }' "$table"
}

exec 3<>"/dev/tcp/127.0.0.1/$port"
{ hello; samples; echo '{"kind": "finish"}'; } >&3
finished=1
while IFS= read -r line <&3; do
    case $line in
    '{"kind": "points", "state": "final"'*) printf '%s\n' "$line" ;;
    '{"kind": "refused"'*) printf '%s\n' "$line" >&2 ;;
    '{"kind": "finished"'*) finished=0 ;;
    esac
done
exit "$finished"
