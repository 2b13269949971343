"""The filters of appendix A and those whose cut-off follows the speed, as stages."""
