#!/bin/sh
# The requests of one run: sh ask.sh RECORDING PROFILE | ./firmware
printf '{"seq": 1, "cmd": "start", "version": 1}\n'
printf '{"seq": 2, "cmd": "run", "recording": "%s/recording.json", "profile": "%s"}\n' "$1" "$2"
printf '{"seq": 3, "cmd": "stop"}\n'
