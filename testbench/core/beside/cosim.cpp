#include "Vold_wrap.h"
#include "Vnew_wrap.h"
#include <random>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
Vold_wrap* o; Vnew_wrap* n; std::mt19937_64 rng; long clocks=0, ticks=0, differ=0, armed=0; long lim[12]={}, seen=0, scene_ticks[16]={}, charge_core=0;
long latency_max=0; long since=-1;
uint32_t rnd(uint32_t m){ return rng()%(uint64_t(m)+1);} bool one(uint32_t m){return rnd(m)==0;}
#define SET(x,v) {auto v_=(v); o->x=v_; n->x=v_;}
int wait_=100, speed=0, ab=0; bool allow_fast=true; int mean=0;
void step(){
  if(one(2000)) speed+= int(rnd(400))-200;
  if(one(60000)) speed=0;
  if(speed>1200)speed=1200; if(speed<-1200)speed=-1200;
  if(--wait_<=0&&speed!=0){ int a=ab>>1,b=ab&1; ab= speed>0? ((!b)<<1|a):(b<<1|!a); wait_=40000/std::abs(speed); if(wait_<30)wait_=30; }
  SET(enc_a_i,ab>>1); SET(enc_b_i,ab&1);
  SET(clk_i,1); o->eval(); n->eval(); SET(clk_i,0); o->eval(); n->eval(); clocks++;
  if(n->sample_o) since=0; else if(since>=0) since++;
  if(n->duty_valid_o&&since>latency_max) latency_max=since;
  if(!o->rst_ni) return;
  if(o->reg_busy_o!=n->reg_busy_o){ if(differ<5)printf("%ld busy %d %d addr %x\n",clocks,o->reg_busy_o,n->reg_busy_o,o->reg_addr_i); differ++; }
  if(n->last_o){ ticks++; armed+=o->armed_o; for(int k=0;k<12;k++) lim[k]+= o->limits_o>>k&1; seen|=o->faults_o; if(o->armed_o) scene_ticks[o->scene_o]++;
    std::string d;
    #define CMP(x) if(o->x!=n->x){ char b[99]; snprintf(b,99," %s %x %x",#x,(unsigned)o->x,(unsigned)n->x); d+=b; }
    CMP(control_o) CMP(tick_count_o) CMP(position_o) CMP(velocity_o) CMP(tau_hat_o) CMP(tau_ref_o) CMP(current_ref_o) CMP(voltage_o) CMP(duty_o) CMP(estimate_o) CMP(scene_o) CMP(limits_o) CMP(faults_o) CMP(first_fault_o) CMP(armed_o) CMP(gates_enable_o) CMP(arm_request_o) CMP(ready_o) CMP(testing_o)
    if(!d.empty()){ if(differ<12)printf("clock %ld tick %ld scene %d armed %d:%s\n",clocks,ticks,o->scene_o,o->armed_o,d.c_str()); differ++; }
  }
}
void clocksn(long k){while(k-->0)step();}
void write(uint32_t a,uint32_t d){ SET(reg_addr_i,a);SET(reg_wdata_i,d);SET(reg_write_i,1); while(o->reg_busy_o) step(); step(); SET(reg_write_i,0);}
uint32_t any(int bits){ int sh=32-(2+rnd(bits-2)); return uint32_t(int32_t(rng())>>sh);}
int main(int c,char**v){ Verilated::commandArgs(c,v); long want=c>1?atol(v[1]):20000; rng.seed(c>2?atol(v[2]):1); o=new Vold_wrap; n=new Vnew_wrap;
  SET(rst_ni,0); SET(clk_i,0); o->eval(); n->eval(); clocksn(5); SET(rst_ni,1); clocksn(500);
  bool faults=c>3;
  if(!faults){ write(0x10,0x7fffffff); write(0x12,0xffffffff); write(0x15,0xffff); write(0x26,0); write(0x2b,0x3fff); }
  int mode=0,scene=0;
  while(ticks<want){
    write(0x200,1); write(0x201,2);
    if(one(3)){
      for(uint32_t a:{8,9,15,4,28,29,22,27,34,50,40,5,7}) write(a,rnd(131071)); write(0x17,any(18)); write(0x21,rnd(2000000)); write(0x27,rnd(400000)); write(0x23,rnd(60000)); write(0x1e,rnd(65536)); write(0x2d,rnd(1100)); write(0x20,rnd(4000));
    }
    if(one(3)){ for(int s=3;s<=9;s++){ write(s*32+1,any(26)>>(one(1)?0:6)); if(s==3||s==7||s==8) write(s*32+2,s==3?any(20):rng()); else write(s*32+2,rnd(131071)); write(s*32+3,rnd(131071)); write(s*32+6,rnd(1)?rnd(3000):0); write(s*32+10, s==3? rnd(100000): rnd(131071)); } write(0x12e,any(1));
      write(0x24,rnd(60000)); write(0x38,rnd(40000)); if(faults){ write(0x2b,rnd(20)); write(0x26,rnd(3)); write(0x25,rnd(6)); write(0x33,rnd(20000)); write(0x29,rnd(3)); write(0x13,rnd(3000000)); write(0x14,rnd(400000)); write(0x15,rnd(300)); write(0x10,rnd(0x7fffffff)); write(0x12,rnd(2000000000)); write(0x11,rnd(100000)); write(0x2e, one(1)?rnd(3000):100000);} }
    mode=rnd(2); scene=rnd(10); if(scene==1)scene=2; if(one(2)) scene=7+rnd(2); 
    int pw=rnd(1)<<10|(faults?rnd(3)<<8:0);
    write(0x200,1|scene<<2|mode<<6|pw); if(one(5)) clocksn(rnd(300)); write(0x200,3|scene<<2|mode<<6|pw);
    int k=rnd(12); while(k-->0){
      switch(rnd(9)){ case 0: write(0x18,rnd(400000)); break; case 1: write(0x4a,any(21)); break; case 2: write(0x1f,any(20)); break; case 3: write(0x19,one(3)?0:any(24)&0x7fffffff); break;
        case 4: scene=rnd(10); if(scene==1)scene=2; write(0x200,3|scene<<2|mode<<6|pw); break; case 5: write(0x201,1); break; case 6: if(faults) write(0x201,4); break; case 7: SET(set_zero_i,1); step(); SET(set_zero_i,0); break;
        case 8: { int s=scene>1?scene:3; write(s*32+(one(1)?10:2), rnd(131071)); if(one(3)) write(s*32+1,any(22)); } break; default:; }
      clocksn(rnd(3000)); if(one(20)) clocksn(rnd(200000)); }
    if(one(20)){ SET(stop_i,1); clocksn(1+rnd(20)); SET(stop_i,0);} 
    if(one(9)){ SET(arm_i,!o->arm_i);} if(one(12)){ SET(scene_i,rnd(10)); write(0x200,0); clocksn(rnd(4000)); }
    if(one(40)){ SET(rst_ni,0); clocksn(1+rnd(9)); SET(rst_ni,1); clocksn(200); }
    if(differ>2000) break;
  }
  printf("%ld ticks, %ld armed, %ld clocks, faults seen %lx, latency %ld, limits", ticks,armed,clocks,seen,latency_max); for(int k=0;k<10;k++)printf(" %ld",lim[k]); printf("; scenes"); for(int k=0;k<11;k++)printf(" %ld",scene_ticks[k]); printf(": %ld differ\n",differ); }
