"""The convergence area: times, isochrones and regions of words on a grid."""
