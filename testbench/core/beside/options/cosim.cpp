#include "Vold_wrap.h"
#include "Vnew_wrap.h"
#include <random>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <cmath>
#ifndef SPEED
#define SPEED 1200
#endif
Vold_wrap* o; Vnew_wrap* n; std::mt19937_64 rng; long clocks=0, ticks=0, differ=0, armed=0; long lim[12]={}, seen=0, scene_ticks[16]={}, charge_core=0;
long latency_max=0; long since=-1;
uint32_t rnd(uint32_t m){ return rng()%(uint64_t(m)+1);} bool one(uint32_t m){return rnd(m)==0;}
#define SET(x,v) {auto v_=(v); o->x=v_; n->x=v_;}
int wait_=100, speed=0, ab=0; bool allow_fast=true; int mean=0;

#ifndef ABS
#define ABS 0
#endif
#ifndef CUR
#define CUR 0
#endif
#ifndef THREE
#define THREE 0
#endif
#ifndef HALL
#define HALL 0
#endif
bool faults_on=false; int whys=0; long armk[4]={}; long pin_differ=0, gates_open=0, per=0; long count=0; double turn=0; // model
// absolute encoder
int sel=1, sclk=0, cmdl=0; uint32_t shift=0, cmd=0, ans=0; int nbits=0, badreads=0; bool flag=false; int illdiag=0; int frozen=0; uint32_t held=0; long nread=0;
uint32_t crc6(uint64_t v,int n){ uint32_t c=0; for(int k=n-1;k>=0;k--){ uint32_t b=(c>>5&1)^(v>>k&1); c=(c<<1&0x3f); if(b) c^=3; } return c; }
uint32_t angle14(){ double t=turn-floor(turn); uint32_t a=uint32_t(t*16384)&16383; if(frozen>0) return held; held=a; return a; }
void begin_read(){ nread++; if(faults_on&&one(60)) badreads=rnd(8); if(faults_on&&one(80)) frozen=rnd(40); if(frozen>0) frozen--; if(faults_on&&one(100)) turn+=rnd(1000)/1000.0;
  if(ABS==1){ uint32_t f=ans; if(flag&&((cmd&0x3fff)!=1)) f|=0x4000; uint32_t x=f&0x7fff; if(__builtin_parity(x)) x|=0x8000; shift=x; if(badreads>0){ badreads--; int w=rnd(3); if(w==0) shift^=1u<<rnd(15); else if(w==1) shift=0xffff; else { flag=true; } } }
  else { uint32_t st=0; if(badreads>0&&one(1)) st=rnd(15); uint64_t v=uint64_t(angle14())<<4|st; uint32_t x=uint32_t(v<<6|crc6(v,18)); if(badreads>0){ badreads--; if(one(1)) x^=1u<<rnd(23);} shift=x; }
  nbits=0; }
void end_read(){ if(ABS==1){ uint32_t a=cmd&0x3fff; if(a==0x3fff) ans=angle14(); else if(a==0x3ffd){ if(faults_on&&one(20)) illdiag=rnd(3); ans=0x100|(illdiag>0?1u<<(9+rnd(2)):0); if(illdiag>0)illdiag--; } else if(a==1){ ans=1; flag=false; } else ans=0; } }
// motor
double ia=0, ib=0, ic=0; double sd[2]={0,0}; int bit_[2]={0,0}; int cclk=0; int stuckm=0;
const double SUP= THREE?5.0:24.0, RR=THREE?2.9:0.42, LL=THREE?1.0e-3:82e-6, FS=THREE?2.0:32.0, KE=THREE?0.039:0.0302; const int PP=11;
double leg(int hi,int lo,double i){ return hi?1:lo?0:i>0?0:1; }
void sensors(){
  if(ABS){ int s=o->encoder_select_no, c=o->encoder_clock_o;
    if(sel&&!s){ begin_read(); cmd=0; if(THREE) {} }
    if(!s&&!sclk&&c){ int fb=ABS==1?16:24; SET(encoder_data_i, nbits<fb? shift>>(fb-1-nbits)&1 : 0); nbits++; }
    if(!s&&sclk&&!c) cmd=cmd<<1|o->encoder_command_o;
    if(!sel&&s) end_read();
    sel=s; sclk=c; }
  if(HALL){ double e=count*8.0/4096; e-=floor(e); int h=0; for(int k=0;k<3;k++){ double d=e-k/3.0+2; d-=floor(d); if(d<0.5) h|=1<<k; } if(faults_on&&one(100000)) stuckm=1000+rnd(4000); if(stuckm>0){ stuckm--; h=stuckm&1024?7:1; } SET(hall_i,h); }
  if(CUR){ const double dt=20e-9; double w=-speed*1250.0/4096*6.283185;
    if(ABS) w=speed/ (1.0e5) *50e6*6.283185/16384.0;
    if(!THREE){ double v=SUP*(leg(o->gate_a_hi_o,o->gate_a_lo_o,ia)-leg(o->gate_b_hi_o,o->gate_b_lo_o,-ia)); bool off=!o->gate_a_hi_o&&!o->gate_a_lo_o&&!o->gate_b_hi_o&&!o->gate_b_lo_o; double ni=ia+dt/LL*(v-RR*ia-(off?0:KE*w)); if(off&&((ia>0)!=(ni>0)||ia==0)) ni=0; ia=ni; }
    else { double va=SUP*leg(o->gate_a_hi_o,o->gate_a_lo_o,ia),vb=SUP*leg(o->gate_b_hi_o,o->gate_b_lo_o,ib),vc=SUP*leg(o->gate_c_hi_o,o->gate_c_lo_o,ic); bool off=!(o->gate_a_hi_o||o->gate_a_lo_o||o->gate_b_hi_o||o->gate_b_lo_o);
      double e=6.283185307*PP*turn; double ea=-KE*w*0*sin(e), eb=0, ec=0; ea=0; double vn=(va+vb+vc)/3; if(off){ ia*=0.9999; ib*=0.9999; ic*=0.9999; } else { ia+=dt/LL*(va-vn-RR*ia-ea); ib+=dt/LL*(vb-vn-RR*ib-eb); ic+=dt/LL*(vc-vn-RR*ic-ec);} }
    int c=o->current_clock_o; if(!cclk&&c){ for(int k=0;k<CUR;k++){ double x=(k?ib:ia)/FS; if(faults_on&&stuckm>0){ stuckm--; } else { sd[k]+=x-(bit_[k]?1:-1); if(sd[k]>2)sd[k]=2; if(sd[k]<-2)sd[k]=-2; bit_[k]=sd[k]>=0; } } if(faults_on&&one(400000)) stuckm=600; SET(current_data_i,bit_[0]|bit_[1]<<1); } cclk=c;
    if(faults_on&&one(400000)) { SET(driver_fault_i,1); } else if(o->driver_fault_i&&one(200)) SET(driver_fault_i,0);
  }
}
void cmp_pins(){ static long shown=0; std::string d;
  #define CP(x) if(o->x!=n->x){ d+=" " #x; }
  CP(encoder_select_no) CP(encoder_clock_o) CP(encoder_command_o) CP(gate_a_hi_o) CP(gate_a_lo_o) CP(gate_b_hi_o) CP(gate_b_lo_o) CP(gate_c_hi_o) CP(gate_c_lo_o) CP(current_clock_o) CP(heartbeat_o) CP(period_start_o) CP(duty_active_o) CP(why_o)
  if(!d.empty()){ pin_differ++; if(shown++<6) printf("clock %ld tick %ld pins:%s\n",clocks,ticks,d.c_str()); }
  gates_open+=o->gate_a_hi_o||o->gate_b_hi_o; }
void step(){
  if(one(2000)) speed+= CUR? int(rnd(20))-10 : int(rnd(400))-200;
  if(!CUR&&one(60000)) speed=0;
  int most=SPEED; if(speed>most)speed=most; if(speed<-most)speed=-most;
  if(--wait_<=0&&speed!=0){ int a=ab>>1,b=ab&1; ab= speed>0? ((!b)<<1|a):(b<<1|!a); count+= speed>0?-1:1; wait_=40000/std::abs(speed); if(wait_<30)wait_=30; }
  turn+=speed/(1.0e5)/16384.0; 
  SET(enc_a_i,ab>>1); SET(enc_b_i,ab&1);
  sensors();
  SET(clk_i,1); o->eval(); n->eval(); SET(clk_i,0); o->eval(); n->eval(); clocks++;
  if(n->sample_o) since=0; else if(since>=0) since++;
  if(n->duty_valid_o&&since>latency_max) latency_max=since;
  if(!o->rst_ni) return;
  cmp_pins();
  if(o->reg_busy_o!=n->reg_busy_o){ if(differ<5)printf("%ld busy %d %d addr %x\n",clocks,o->reg_busy_o,n->reg_busy_o,o->reg_addr_i); differ++; }
  if(n->last_o){ ticks++; armed+=o->armed_o; static int wl=0; if(o->why_o&~0x10&&wl<0){wl++; printf("why %x tick %ld\n",o->why_o,ticks);} whys|=o->why_o; armk[o->control_o&3]++; for(int k=0;k<12;k++) lim[k]+= o->limits_o>>k&1; seen|=o->faults_o; if(o->armed_o) scene_ticks[o->scene_o]++;
    std::string d;
    #define CMP(x) if(o->x!=n->x){ char b[99]; snprintf(b,99," %s %x %x",#x,(unsigned)o->x,(unsigned)n->x); d+=b; }
    CMP(control_o) CMP(tick_count_o) CMP(position_o) CMP(velocity_o) CMP(tau_hat_o) CMP(tau_ref_o) CMP(current_ref_o) CMP(voltage_o) CMP(duty_o) CMP(estimate_o) CMP(scene_o) CMP(limits_o) CMP(faults_o) CMP(first_fault_o) CMP(armed_o) CMP(gates_enable_o) CMP(arm_request_o) CMP(ready_o) CMP(testing_o) CMP(bridge_current_o)
    if(!d.empty()){ if(differ<12)printf("clock %ld tick %ld scene %d armed %d:%s\n",clocks,ticks,o->scene_o,o->armed_o,d.c_str()); differ++; }
  }
}
void clocksn(long k){while(k-->0)step();}
void write(uint32_t a,uint32_t d){ SET(reg_addr_i,a);SET(reg_wdata_i,d);SET(reg_write_i,1); while(o->reg_busy_o) step(); step(); SET(reg_write_i,0);}
uint32_t any(int bits){ int sh=32-(2+rnd(bits-2)); return uint32_t(int32_t(rng())>>sh);}
int main(int c,char**v){ Verilated::commandArgs(c,v); long want=c>1?atol(v[1]):20000; rng.seed(c>2?atol(v[2]):1); o=new Vold_wrap; n=new Vnew_wrap;
  SET(rst_ni,0); SET(clk_i,0); o->eval(); n->eval(); clocksn(5); SET(rst_ni,1); clocksn(500); if(CUR) clocksn(540000); ticks=0;
  bool faults=c>3; faults_on=faults; 
  if(!faults){ write(0x10,0x7fffffff); write(0x12,0xffffffff); write(0x15,0xffff); write(0x26,0); write(0x2b,0x3fff); }
  int mode=0,scene=0;
  while(ticks<want){
    write(0x200,1); write(0x201,2);
    if(one(3)){
      for(uint32_t a:{8,9,15,4,28,29,22,27,34,50,40,5,7}) if(!CUR||faults||(a!=22&&a!=29)) write(a,rnd(131071)); write(0x17,any(18)); write(0x21,rnd(2000000)); write(0x27,rnd(400000)); write(0x23,rnd(60000)); write(0x1e,rnd(65536)); write(0x2d,rnd(1100)); write(0x20,rnd(4000));
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
    if(one(CUR?2000:40)){ SET(rst_ni,0); clocksn(1+rnd(9)); SET(rst_ni,1); clocksn(200); }
    if(differ>2000) break;
  }
  printf("%ld ticks, %ld armed, %ld clocks, faults seen %lx, latency %ld, limits", ticks,armed,clocks,seen,latency_max); for(int k=0;k<10;k++)printf(" %ld",lim[k]); printf("; scenes"); for(int k=0;k<11;k++)printf(" %ld",scene_ticks[k]); printf(": %ld differ; pins %ld of clocks, gates %ld, reads %ld, why %x\n",differ,pin_differ,gates_open,nread,whys); }
